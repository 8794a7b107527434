#pragma once

#include <Eigen/Core>

#include "observe/skin_model.h"
#include "sensor/rgbd_frame.h"
#include "stages/preprocess/params.h"

namespace barehand {

/// The whole frame in cells of step x step pixels, so that it can be searched in every frame.
struct CoarseGrid {
  int step = 1;       ///< pixels per cell side
  Intrinsics camera;  ///< intrinsics of the grid: cell (c, r) is a pixel of this camera
  Image<float> z;     ///< median depth of the cell [m]; 0 = no depth in the working range
  Image<Rgb> colour;  ///< colour of the pixel whose depth is z; black = none
  Image<float> odds;  ///< log odds of skin, of that pixel or of the cell's mean, whichever is weaker; 0 = no evidence
  bool coloured = false;  ///< false: there is no colour, or the image is grey, so depth alone decides

  Eigen::Vector3f point(int c, int r) const {
    const float depth = z.at(c, r);
    return {static_cast<float>((c - camera.cx) / camera.fx) * depth,
            static_cast<float>((r - camera.cy) / camera.fy) * depth, depth};
  }
  /// The frame pixel at the centre of a cell.
  Eigen::Vector2d frame_pixel(int c, int r) const {
    const double centre = 0.5 * (step - 1);
    return {c * step + centre, r * step + centre};
  }
  /// Area [m^2] that a cell covers at depth z, facing the camera.
  float cell_area(float depth) const { return static_cast<float>(depth * depth / (camera.fx * camera.fy)); }
};

/// Standard deviation [m] that is assumed for one depth measurement at depth `z` [m] before the noise is measured.
inline float depth_noise(float z) {
  const float away = z > 0.4f ? z - 0.4f : 0.f;
  return 0.0012f + 0.0019f * away * away;
}

/// Largest depth step [m] between neighbouring pixels of one surface at depth `z` [m]: four pixel widths z / fx plus
/// three standard deviations of the sensor's noise. Steep slopes stay below it; the gap between a fingertip and what is
/// behind it does not.
inline float same_surface_step(float z, float fx) { return 4.f * z / fx + 3.f * depth_noise(z); }

/// Fills `grid` from the frame and reuses its memory. The depth of a cell is the median of five samples, so that single
/// missing or flying pixels do not matter.
void sample_coarsely(const RgbdFrame& frame, const PreprocessParams& params, const SkinModel& skin, CoarseGrid& grid);

}  // namespace barehand
