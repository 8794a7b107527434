#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "stages/contact/surface_cells.h"

namespace barehand {

/// The skin of one segment in the camera frame [m].
struct PosedSkin {
  std::vector<Eigen::Vector3f> points, normals;  ///< the normals point outwards
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  float radius = 0;  ///< all points are within this distance of the centre
};

/// The surface nearest to a segment's skin.
struct NearestSurface {
  float distance = 0;   ///< signed, negative inside [m]
  float deviation = 0;  ///< of the distance, because the surface is only known nearby [m]
  Eigen::Vector3f point, normal;
  std::int32_t object = -1;
};

/// Measures how far skin is from surfaces that are known in points only. Around each skin point x the surface is the
/// weighted mean of the planes of the known points p_i with normals n_i (implicit moving least squares):
///
///     f(x) = sum w_i n_i (x - p_i) / sum w_i,  w_i = exp(-(|x - p_i|^2 - d^2) / h^2),  d = min |x - p_i|
///
/// Where skin covers the surface, the nearest known point is some way aside. The surface may go on as that plane, at
/// the distance f, or end right there, at the distance d; the estimate lies between, with a deviation to match. It does
/// not go on into the skin: there, 0 takes the place of a negative f.
class SurfaceDistance {
 public:
  /// Surfaces farther from the skin than this are not measured [m].
  static constexpr float kReach = 0.03f;

  /// None: no surface is within kReach, apart from those that the skin is behind.
  std::optional<NearestSurface> measure(const PosedSkin& skin, std::span<const SurfacePoint> surface);

 private:
  std::vector<const SurfacePoint*> close_;  // to the segment
  std::vector<float> distance_sq_;          // of each of them to a skin point
};

}  // namespace barehand
