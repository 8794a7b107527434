#pragma once

#include <algorithm>

namespace barehand {

/// Where on the way from `a` to `b` the point nearest to `p` lies: 0 at `a`, 1 at `b`; 0 if they are the same point.
template <class Vector>
typename Vector::Scalar share_along(const Vector& a, const Vector& b, const Vector& p) {
  using Scalar = typename Vector::Scalar;
  const Vector way = b - a;
  return std::clamp((p - a).dot(way) / std::max(way.squaredNorm(), Scalar(1e-12)), Scalar(0), Scalar(1));
}

/// Distance of `p` from the line segment between `a` and `b`.
template <class Vector>
typename Vector::Scalar segment_distance(const Vector& a, const Vector& b, const Vector& p) {
  return (p - a - share_along(a, b, p) * (b - a)).norm();
}

}  // namespace barehand
