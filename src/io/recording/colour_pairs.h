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
      colour;               ///< for each depth image, the index of its colour image; none: no image is near enough
  std::int64_t window = 0;  ///< largest difference of the two time stamps of a pair: one frame interval [us]
};

/// Pairs depth and colour images by their time stamps [us]. `depth` is in the order of recording; `colour` may be in
/// any order. If the recorder was restarted within the recording (kRestart), the parts of both lists are paired in
/// their order, so that no frame gets the colour of another part with the same time.
ColourPairs pair_colour(std::span<const std::int64_t> depth, std::span<const std::int64_t> colour);

}  // namespace barehand
