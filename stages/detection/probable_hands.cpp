// Sorts detections by how probably they are hands.
#include "stages/detection/probable_hands.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace barehand {
namespace {

/// Logarithm of the probability that has these log odds.
double log_probability(double log_odds) {
  return log_odds > 0 ? -std::log1p(std::exp(-log_odds)) : log_odds - std::log1p(std::exp(log_odds));
}

}  // namespace

void sort_by_probability(std::vector<DetectedHand>& hands, std::optional<Handedness> wanted) {
  const auto rating = [&](const DetectedHand& hand) {
    return hand.hand_log_odds + (wanted ? log_probability(side_sign(*wanted) * hand.right_log_odds) : 0);
  };
  std::ranges::stable_sort(hands, std::greater<>(), rating);
}

}  // namespace barehand
