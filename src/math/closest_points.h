#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace barehand {

/// The two ends of a line segment.
using LineSegment = std::array<Eigen::Vector3d, 2>;

/// The closest points of two line segments of non-zero length (Ericson, Real-Time Collision Detection, 5.1.9).
inline std::array<Eigen::Vector3d, 2> closest_points(const LineSegment& a, const LineSegment& b) {
  constexpr double kTiny = 1e-12;  // squared lengths below this count as zero [m^2]
  const Eigen::Vector3d d_a = a[1] - a[0], d_b = b[1] - b[0], r = a[0] - b[0];
  const double aa = d_a.squaredNorm(), bb = d_b.squaredNorm(), ab = d_a.dot(d_b);
  const double ar = d_a.dot(r), br = d_b.dot(r), parallel = aa * bb - ab * ab;
  double s = parallel > kTiny * kTiny ? std::clamp((ab * br - ar * bb) / parallel, 0.0, 1.0) : 0.0;
  const double t = std::clamp((ab * s + br) / bb, 0.0, 1.0);
  s = std::clamp((ab * t - ar) / aa, 0.0, 1.0);
  return {a[0] + s * d_a, b[0] + t * d_b};
}

}  // namespace barehand
