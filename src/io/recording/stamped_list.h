#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// One line "timestamp file" of depth.txt or rgb.txt.
struct StampedFile {
  std::int64_t utime = 0;  ///< time stamp [us]
  std::string file;        ///< path of the file: the name in the line, relative to the list's folder unless absolute
  int line = 0;            ///< number of the line, from 1
};

/// Reads a list of such lines, in their order. The name is the rest of the line, or stands in double quotes; '#' at
/// the start of a line or after a space begins a comment. If there is no file of that name, "\" in it is read as "/",
/// and if there is still none, the name is taken to end at its first space. A first line without any digit in its first
/// word is a header. An error names the invalid line.
Result<std::vector<StampedFile>> read_stamped_list(const std::string& path);

/// Whether `file`, by its name, is neither in `folder` nor below it. Links are not followed.
bool is_outside(const std::string& folder, const std::string& file);

}  // namespace barehand
