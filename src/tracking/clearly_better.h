#pragma once

namespace barehand {

/// What another side or size of a hand must be better by to be preferred.
inline constexpr double kHandAdvantage = 0.1;

/// Whether a pose or a hand explains an observation better than another one does, by `advantage` (global scores).
inline bool clearly_better(double score, double other, double advantage = kHandAdvantage) {
  return score < other * (1 - advantage);
}

}  // namespace barehand
