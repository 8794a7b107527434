#pragma once

#include "hand/surface.h"
#include "stages/segment_tracker/pixel_map.h"

namespace barehand {

/// One sample's skin against the data (paper Sec. 4.1, 4.2). Weights are the pixels that the skin points cover.
struct PatchDistance {
  float distance = 0;  ///< sum of weight * d_x over the counted points (Eq. 1) [pixel m]
  float counted = 0;   ///< weight of the points that are neither occluded nor without data [pixel]
  float total = 0;     ///< weight of all front-facing points [pixel]

  /// Mean over counted pixels: d hat of Eq. 2 [m]; 0 where nothing is counted.
  double mean() const { return counted > 0 ? distance / counted : 0; }
  double counted_fraction() const { return total > 0 ? counted / total : 0; }
};

/// `T_camera_segment`: the sample. `cap` [m] bounds a single pixel's distance (infinity: Eq. 1 as it is). Exact up to
/// single precision; the order of sums is fixed for a given instruction set.
PatchDistance patch_distance(const SegmentSurface& skin, const SE3& T_camera_segment, int segment, const PixelMap& map,
                             float cap);

}  // namespace barehand
