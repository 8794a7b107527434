#pragma once

#include <Eigen/Core>
#include <functional>
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
  float deviation = 0;  ///< standard deviation of the distance, because the surface is only known nearby [m]
  Eigen::Vector3f point, normal;
  std::int32_t object = -1;
};

/// Measures how far skin is from surfaces that are known in points only. Around each skin point x the surface is the
/// weighted mean of the planes of the known points p_i with normals n_i (implicit moving least squares):
///
///     f(x) = sum w_i n_i (x - p_i) / sum w_i,  w_i = exp(-(|x - p_i|^2 - d^2) / h^2),  d = min |x - p_i|
///
/// Where skin covers the surface, the nearest known point p is some way to the side. The surface continues from there
/// towards the foot of x in that plane, with the curvature that it has around p, up to a place that is seen to be
/// empty: its edge. Behind the edge it may continue along the ray, hidden by itself. It does not continue into the
/// skin: there, 0 takes the place of a negative f.
class SurfaceDistance {
 public:
  /// Surfaces farther from the skin than this are not measured [m].
  static constexpr float kReach = 0.03f;
  /// Whether a place (camera frame [m]) is known to be empty of an object.
  using SeenEmpty = std::function<bool(std::int32_t object, const Eigen::Vector3f& place)>;

  /// None: no surface is within kReach, apart from those that the skin is behind.
  std::optional<NearestSurface> measure(const PosedSkin& skin, std::span<const SurfacePoint> surface,
                                        const SeenEmpty& empty);

 private:
  /// The known surface around a skin point.
  struct Plane {
    const SurfacePoint* nearest = nullptr;
    float apart = 0;   // distance of that point [m]
    float height = 0;  // f [m]
    Eigen::Vector3f normal;
  };

  bool find_plane(const Eigen::Vector3f& x, Plane& plane);
  NearestSurface extend(const Eigen::Vector3f& x, const Plane& plane, const SeenEmpty& empty) const;
  float bend(const SurfacePoint& p, const Eigen::Vector3f& direction) const;

  std::vector<SurfacePoint> close_;             // known points close to the segment
  std::vector<float> x_, y_, z_, distance_sq_;  // their places, and their distances from a skin point, squared
};

}  // namespace barehand
