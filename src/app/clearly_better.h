#pragma once

namespace barehand {

/// Whether one hand explains an observation so much better than another one does (global scores) that it is that one.
inline bool clearly_better(double score, double other) {
  constexpr double kAdvantage = 0.1;
  return score < other * (1 - kAdvantage);
}

}  // namespace barehand
