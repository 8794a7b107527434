#pragma once

#include <numbers>

namespace barehand {

/// One degree in radians.
inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace barehand
