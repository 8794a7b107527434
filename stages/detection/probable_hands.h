#pragma once

#include <optional>
#include <vector>

#include "observe/detection.h"

namespace barehand {

/// Sorts detected hands, the one that most probably is a hand first. If `wanted` is given, only a hand of that side
/// counts, so that the other hand of a person comes after it.
void sort_by_probability(std::vector<DetectedHand>& hands, std::optional<Handedness> wanted);

}  // namespace barehand
