#pragma once

#include "observe/skin_model.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// A window ("view") of the depth image, resampled for a network. It is a virtual pinhole camera with the optical
/// centre and the axes of the real one: a grid of square pixels over the depth image, independent of that image's
/// resolution and focal length. The middle of the grid lies on frame pixel (u0, v0).
struct DepthView {
  int width = 0, height = 0;
  double focal = 0;               ///< [pixels of the view]
  double u0 = 0, v0 = 0;          ///< frame pixel in the middle of the view
  double step_u = 1, step_v = 1;  ///< frame pixels per pixel of the view

  DepthView(int width, int height, double focal, double u0, double v0, const Intrinsics& camera)
      : width(width),
        height(height),
        focal(focal),
        u0(u0),
        v0(v0),
        step_u(camera.fx / focal),
        step_v(camera.fy / focal) {}

  /// Frame pixel that corresponds to a pixel of the view; both may be fractional.
  Eigen::Vector2d frame_pixel(double u, double v) const {
    return {u0 + (u - 0.5 * (width - 1)) * step_u, v0 + (v - 0.5 * (height - 1)) * step_v};
  }
};

/// Sets each pixel of `depth` to the depth [m] of the frame pixel nearest to it; 0 if that has no depth or lies outside
/// the frame.
void sample_depth(const RgbdFrame& frame, const DepthView& view, Image<float>& depth);
/// Moves everything that does not have the colour of skin far away, in the depth of a view of a frame with colour.
void keep_skin(const RgbdFrame& frame, const DepthView& view, const SkinModel& skin, Image<float>& depth);

}  // namespace barehand
