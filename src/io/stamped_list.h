#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// One line "timestamp file" of depth.txt or rgb.txt.
struct StampedFile {
  std::int64_t utime = 0;  ///< microseconds
  std::string file;        ///< path to open: the list's folder and the name in the line
  int line = 0;            ///< counted from 1
};

/// Reads such a list in its own order; '#' starts a comment. An error names the line that makes no sense.
Result<std::vector<StampedFile>> read_stamped_list(const std::string& path);

}  // namespace barehand
