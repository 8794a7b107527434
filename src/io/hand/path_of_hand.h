#pragma once

#include <string>

#include "hand/segments.h"

namespace barehand {

/// The path of a file of the k-th hand: `path` for the first hand; for another one, `path` with its side, such as
/// out_left.csv for out.csv.
std::string path_of_hand(const std::string& path, int k, Handedness side);

}  // namespace barehand
