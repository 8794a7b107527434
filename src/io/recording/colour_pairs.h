#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/recording/stamped_list.h"

namespace barehand {

/// Which colour image belongs to each depth image of a recording.
struct ColourPairs {
  std::vector<std::string> files;  ///< by depth image: path to open; "": none is near enough in time
  std::int64_t window = 0;         ///< [us] the farthest that a colour image may be: one frame interval
};

/// Pairs by the nearest time. `depth` is in the order of recording, colour may be in any. Where the time starts anew
/// within the recording (kRestart), the parts of both lists are paired in their order, so that no frame gets the colour
/// of another part that had the same time.
ColourPairs pair_colour(const std::vector<StampedFile>& depth, const std::vector<StampedFile>& colour);

}  // namespace barehand
