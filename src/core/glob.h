#pragma once

#include <string>
#include <string_view>

namespace barehand {

/// Whether a glob matches a channel's whole name. '*' stands for any bytes, '?' for one byte, and everything else,
/// brackets and backslashes too, for itself.
bool matches_glob(std::string_view glob, std::string_view name);

/// The regular expression, in LCM's syntax, that matches the same names as the glob.
std::string glob_to_regex(const std::string& glob);

}  // namespace barehand
