#pragma once

#include <cmath>

namespace barehand {

/// Geometric passage from `start` (step 0) to `end` (step steps - 1) for positive values; `start` where there is one
/// step.
inline double geometric(double start, double end, int step, int steps) {
  return steps < 2 ? start : start * std::pow(end / start, static_cast<double>(step) / (steps - 1));
}

}  // namespace barehand
