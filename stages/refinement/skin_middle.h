#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "hand/skin.h"

namespace barehand {

/// Where the middle of a bone's skin from side to side meets the joint that the bone begins at.
struct SkinMiddle {
  double x = 0;                                    ///< in the bone's frame [m]
  std::vector<std::pair<int, double>> per_offset;  ///< vertex, and how x changes as it moves along its normal
};
/// From skin that follows `segment` alone, a bone of `length` [m] along -z: elliptic sections along a straight line,
/// continued to the joint, as webs hide what is there. None: too little skin.
std::optional<SkinMiddle> skin_middle(const Skin& skin, int segment, double length);

}  // namespace barehand
