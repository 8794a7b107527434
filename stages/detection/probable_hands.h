#pragma once

#include <optional>
#include <vector>

#include "observe/detection.h"

namespace barehand {

/// From these log odds of the side on, either way, the networks tell it: of most hands they are 4 to 20.
inline constexpr double kToldSide = 3;

/// Cues from the outputs of the networks on whether a detected hand really is a hand. The networks also report palms on
/// feet, faces and held objects, and at the end of an arm whose hand is hidden. There the cues contradict each other.
struct NetworkCues {
  double palm = 0;    ///< probability that the network assigns to the palm (DetectedHand::palm)
  double side = 0;    ///< how clearly it is a left or a right hand: absolute value of DetectedHand::right_log_odds
  double labels = 0;  ///< mean log odds of the hand over the cells of the window that are labelled as hand
};
NetworkCues network_cues(const DetectedHand& detected);

/// Log odds, up to a constant, that a detection is a hand and not something else: the part of the logistic model in
/// docs/method.md that needs the outputs of the networks only.
double network_log_odds(const NetworkCues& cues);

/// Sorts detected hands, the one that most probably is a hand first. If `wanted` is given, only a hand of that side
/// counts, so that the other hand of a person comes after it.
void sort_by_probability(std::vector<DetectedHand>& hands, std::optional<Handedness> wanted);

}  // namespace barehand
