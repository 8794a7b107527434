#pragma once

#include <string>
#include <vector>

#include "hand/profile.h"

namespace barehand {

/// What looks wrong about a profile that is possible, in sentences with the likely cause: a hand of a size that nobody
/// has, joints beside the bones they belong to. Empty: nothing.
std::vector<std::string> profile_doubts(const HandProfile& profile);

/// Whether most joints may bend by so little that their limits must be radians that were taken for degrees.
bool limits_look_like_radians(const HandProfile& profile);

}  // namespace barehand
