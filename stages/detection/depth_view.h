#pragma once

#include "sensor/rgbd_frame.h"

namespace barehand {

/// A virtual pinhole camera at the place of the real one: a grid of square pixels laid over the depth image, whatever
/// resolution and focal length that has. It looks at the frame pixel (u0, v0) in its middle.
struct DepthView {
  int width = 0, height = 0;
  double focal = 0;               ///< [pixels of the view]
  double u0 = 0, v0 = 0;          ///< frame pixel in the middle
  double step_u = 1, step_v = 1;  ///< frame pixels per pixel of the view

  DepthView(int width, int height, double focal, double u0, double v0, const Intrinsics& camera)
      : width(width),
        height(height),
        focal(focal),
        u0(u0),
        v0(v0),
        step_u(camera.fx / focal),
        step_v(camera.fy / focal) {}

  /// Frame pixel of a pixel of the view; both may lie between pixels.
  Eigen::Vector2d frame_pixel(double u, double v) const {
    return {u0 + (u - 0.5 * (width - 1)) * step_u, v0 + (v - 0.5 * (height - 1)) * step_v};
  }
};

/// The depth [m] that each pixel of the view sees in its nearest frame pixel; 0: none.
void sample_depth(const RgbdFrame& frame, const DepthView& view, Image<float>& depth);

}  // namespace barehand
