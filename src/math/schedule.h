#pragma once

#include <cmath>

namespace barehand {

/// Value at `step` of a geometric progression of positive values from `start` (at step 0) to `end` (at step steps - 1).
/// If there is only one step, the value is `start`.
inline double geometric(double start, double end, int step, int steps) {
  return steps < 2 ? start : start * std::pow(end / start, static_cast<double>(step) / (steps - 1));
}

}  // namespace barehand
