// Decides by the outputs of the networks whether what they detected is a hand.
#include "stages/detection/network_cues.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace barehand {
namespace {

// Weights of the logistic model that tells hands from other objects, one for each cue.
constexpr double kOfPalm = 0.5, kOfSide = 1.3, kOfLabels = 1.0;
// Limits to which the cues are clamped, because values beyond them carry no further information.
constexpr double kSurestPalm = 0.95, kLeastPalm = 0.01, kClearSide = 6;

/// Logarithm of the probability that has these log odds.
double log_probability(double log_odds) {
  return log_odds > 0 ? -std::log1p(std::exp(-log_odds)) : log_odds - std::log1p(std::exp(log_odds));
}

}  // namespace

NetworkCues network_cues(const DetectedHand& detected) {
  NetworkCues cues;
  cues.palm = detected.palm;
  cues.side = std::abs(detected.right_log_odds);

  // Average the log odds of the cells that are labelled as hand, each limited to kSure.
  double sum = 0;
  int count = 0;
  const LabelMap& labels = detected.labels;
  for (std::size_t i = 0; i < labels.label.size(); ++i) {
    if (labels.label[i] != SurfaceLabel::hand) continue;
    constexpr float kSure = 20;
    sum += std::min(kSure, labels.hand_log_odds[i]);
    ++count;
  }

  // Without such a cell, the cue keeps its default.
  if (count) cues.labels = sum / count;
  return cues;
}

double network_log_odds(const NetworkCues& cues) {
  const double palm = std::clamp(cues.palm, kLeastPalm, kSurestPalm);
  return kOfPalm * std::log(palm / (1 - palm)) + kOfSide * std::min(cues.side, kClearSide) + kOfLabels * cues.labels;
}

void sort_by_probability(std::vector<DetectedHand>& hands, std::optional<Handedness> wanted) {
  const auto rating = [&](const DetectedHand& hand) {
    const double is_hand = network_log_odds(network_cues(hand));
    return wanted ? is_hand + log_probability(side_sign(*wanted) * hand.right_log_odds) : is_hand;
  };
  std::ranges::stable_sort(hands, std::greater<>(), rating);
}

}  // namespace barehand
