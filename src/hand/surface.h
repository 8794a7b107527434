#pragma once

#include <array>
#include <vector>

#include "hand/profile.h"

namespace barehand {

/// Skin of one segment as surface points in the segment frame [m], laid out for SIMD. A point stands for `area` of
/// skin; seen by a camera it covers area * max(0, -n.view) / z^2 pixels: the weight that makes a mean over points
/// equal the paper's mean over rendered pixels (Sec. 4.1).
struct SegmentSurface {
  std::vector<float> x, y, z;     ///< position
  std::vector<float> nx, ny, nz;  ///< outward unit normal
  std::vector<float> area;        ///< [m^2]
  std::size_t size() const { return x.size(); }
};
using HandSurface = std::array<SegmentSurface, kSegmentCount>;

/// The paper's skin (Sec. 3.1): tapered cylinders around the bones, a spherical cap on the tips. The palm, which the
/// paper does not observe, gets an elliptic slab of the profile's width, thickness and flesh offset. Open where
/// segments meet. Exactly `points_per_segment` (> 0) evenly spread points each; every segment needs a length.
HandSurface make_cylinder_surface(const HandProfile& profile, int points_per_segment);

}  // namespace barehand
