#pragma once

#include <string>

#include "core/error.h"

namespace barehand {

/// Reads a whole file. The content of a pipe is kept, so that later calls return it again. Errors: there is no such
/// file, it is not readable or a folder, the disk fails, or a pipe delivers more than 64 MiB.
Result<std::string> read_file(const std::string& path);

/// Reads a text file in UTF-8, without its byte order mark and with "\n" at the end of every line. UTF-16 is an error,
/// too.
Result<std::string> read_text(const std::string& path);

/// Whether the path can be read only once: a pipe, <(...) of a shell, a terminal.
bool is_pipe(const std::string& path);

/// Whether there is no file at `path`. False if that cannot be found out (no permission, too long a name); opening the
/// file then reports why.
bool is_missing(const std::string& path);

}  // namespace barehand
