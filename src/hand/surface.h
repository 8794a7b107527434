#pragma once

#include <array>
#include <vector>

#include "hand/profile.h"

namespace barehand {

/// The skin of one segment as surface points in the segment frame [m], laid out for SIMD. A point represents `area` of
/// skin and covers about fx fy area max(0, -n . view) / z^2 pixels of an image, where `view` is the unit vector from
/// the camera to the point. With this weight, a mean over points equals the paper's mean over rendered pixels (Sec.
/// 4.1).
struct SegmentSurface {
  std::vector<float> x, y, z;     ///< positions in the segment frame [m]
  std::vector<float> nx, ny, nz;  ///< outward unit normals
  std::vector<float> area;        ///< area of skin that each point represents [m^2]
  std::size_t size() const { return x.size(); }
};
using HandSurface = std::array<SegmentSurface, kSegmentCount>;

/// Points of a surface that are closer to the camera than this are ignored, since no depth sensor sees them [m].
inline constexpr float kNearestSeen = 0.01f;

/// The paper's skin (Sec. 3.1): tapered cylinders around the bones with a spherical cap on each fingertip. The palm,
/// which the paper does not observe, gets an elliptic slab of the profile's width, thickness and flesh offset. The
/// surface is open where segments meet. Every segment gets exactly `points_per_segment` (> 0) evenly spread points and
/// must have a length.
HandSurface make_cylinder_surface(const HandProfile& profile, int points_per_segment);

}  // namespace barehand
