#include "observe/detection.h"

#include <algorithm>

namespace barehand {

float LabelMap::hand_odds_at(double u, double v) const {
  const double c = std::clamp((u - u0) / step_u, 0.0, hand_log_odds.width() - 1.0);
  const double r = std::clamp((v - v0) / step_v, 0.0, hand_log_odds.height() - 1.0);
  const int c0 = std::min(static_cast<int>(c), hand_log_odds.width() - 2);
  const int r0 = std::min(static_cast<int>(r), hand_log_odds.height() - 2);
  const auto a = static_cast<float>(c - c0), b = static_cast<float>(r - r0);
  const float *above = hand_log_odds.row(r0) + c0, *below = hand_log_odds.row(r0 + 1) + c0;
  return (1 - b) * ((1 - a) * above[0] + a * above[1]) + b * ((1 - a) * below[0] + a * below[1]);
}

}  // namespace barehand
