#pragma once

#include <string>

#include "core/error.h"

namespace barehand {

/// A whole file. What comes from a pipe is kept, so that whoever asks for it again gets it again. Errors: not there,
/// not readable, a folder, a disk that fails, a pipe that brings more than any of these files has.
Result<std::string> read_file(const std::string& path);

/// The same of a text in UTF-8: without its byte order mark, and every line ends in "\n". UTF-16 is an error, too.
Result<std::string> read_text(const std::string& path);

/// Something is there that can be read only once: a pipe, <(...) of a shell, a terminal.
bool is_pipe(const std::string& path);

/// Nothing is there. Not so where nobody can look (no permission, too long a name): opening it says why.
bool is_missing(const std::string& path);

}  // namespace barehand
