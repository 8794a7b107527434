#pragma once

#include <string>
#include <string_view>

namespace barehand {

/// Whether a channel's name is what a glob says, where '*' stands for any bytes, '?' for one, and everything else,
/// brackets and back slashes too, for itself.
bool matches_glob(std::string_view glob, std::string_view name);

/// The same as the regular expression that LCM wants.
std::string glob_to_regex(const std::string& glob);

}  // namespace barehand
