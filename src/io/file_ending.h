#pragma once

#include <string>

namespace barehand {

/// The ending of a file's name with its dot, in lower case; "" if it has none.
std::string lower_case_ending(const std::string& path);

}  // namespace barehand
