#pragma once

#include <string>

#include "hand/segments.h"

namespace barehand {

/// Where a file of the k-th hand is: the first one's at `path`, that of another one, of the other side, beside it:
/// out.csv, out_left.csv.
std::string path_of_hand(const std::string& path, int k, Handedness side);

}  // namespace barehand
