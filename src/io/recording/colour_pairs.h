#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace barehand {

/// Which colour image belongs to each depth image of a recording.
struct ColourPairs {
  std::vector<std::optional<std::size_t>>
      colour;               ///< by depth image: index of its colour; none: no image is near enough
  std::int64_t window = 0;  ///< [us] the farthest that a colour image may be: one frame interval
};

/// Pairs by the nearest time [us]. `depth` is in the order of recording, colour may be in any. Where the time starts
/// anew within the recording (kRestart), the parts of both lists are paired in their order, so that no frame gets the
/// colour of another part that had the same time.
ColourPairs pair_colour(std::span<const std::int64_t> depth, std::span<const std::int64_t> colour);

}  // namespace barehand
