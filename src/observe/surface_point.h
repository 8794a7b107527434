#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace barehand {

/// A point on the surface of an object, not of a hand. Camera frame [m].
struct SurfacePoint {
  Eigen::Vector3f p, n;        ///< place and outward unit normal
  std::int32_t component = 0;  ///< the connected surface that it belongs to; -1: it was seen before and is hidden
  std::int32_t object = -1;    ///< ObjectEstimate::id; -1: none
};

}  // namespace barehand
