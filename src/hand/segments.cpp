#include "hand/segments.h"

#include <algorithm>

namespace barehand {

std::optional<int> segment_from_name(std::string_view name) {
  const auto it = std::find(kSegmentNames.begin(), kSegmentNames.end(), name);
  if (it == kSegmentNames.end()) return std::nullopt;
  return static_cast<int>(it - kSegmentNames.begin());
}

std::string_view to_string(Handedness side) { return side == Handedness::left ? "left" : "right"; }

}  // namespace barehand
