#pragma once

#include "core/error.h"

namespace barehand {

/// Call it first in the program. Descriptors 0 to 2 that are closed are connected to /dev/null: otherwise the next file
/// that is opened would get such a number, and messages would be written into it. Writing to a pipe without a reader,
/// or beyond the limit on the size of files, becomes an error of that write instead of the end of the process.
void prepare_standard_streams();

/// Whether the reader of the standard output (the other end of a pipe, a terminal) has gone.
bool output_is_closed();

/// Returns the exit code of a command that has printed something: `exit_code` if all of it was written, kExitBrokenPipe
/// if its reader has gone, and kExitFailure, with a line on standard error, if it could not be written.
int printed(int exit_code);

/// Says on standard error what ended `barehand COMMAND`, and returns `exit_code`.
int failed(const char* command, const Error& error, int exit_code);

}  // namespace barehand
