#pragma once

#include <string>
#include <vector>

#include "hand/profile.h"

namespace barehand {

/// Warnings about a profile that is valid but unlikely, as sentences with the likely cause: a hand of a size that
/// nobody has, or joints that are not at the ends of their bones. Empty if nothing looks wrong.
std::vector<std::string> profile_warnings(const HandProfile& profile);

/// Whether most joints can bend so little that their limits must be radians that were read as degrees.
bool limits_look_like_radians(const HandProfile& profile);

}  // namespace barehand
