#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "hand/hand_pose.h"

namespace barehand {

/// Name of a state, such as "searching", for messages and images.
constexpr std::string_view to_string(TrackStatus status) {
  constexpr std::array<std::string_view, 4> kNames = {"searching", "tracking", "holding", "lost"};
  return kNames[static_cast<std::size_t>(status)];
}

/// The states of all hands, such as "tracking, lost".
inline std::string status_list(std::span<const TrackStatus> hands) {
  std::string list;
  for (const TrackStatus status : hands) list.append(list.empty() ? "" : ", ").append(to_string(status));
  return list;
}

}  // namespace barehand
