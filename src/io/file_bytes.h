#pragma once

#include <string>

#include "core/error.h"

namespace barehand {

/// A whole file. Errors: not there, not readable, a folder, a disk that fails.
Result<std::string> read_file(const std::string& path);

/// Nothing is there. Not so where nobody can look (no permission, too long a name): opening it says why.
bool is_missing(const std::string& path);

}  // namespace barehand
