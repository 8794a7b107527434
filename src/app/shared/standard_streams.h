#pragma once

namespace barehand {

/// First thing in the program. A descriptor of 0 to 2 that is closed is led to /dev/null: else the first file that is
/// opened would get its number, and messages would land in data. Writing to a pipe that nobody reads, or beyond a limit
/// on the size of files, becomes an error of that write instead of the end of the process.
void prepare_standard_streams();

/// Whether whoever read the standard output is gone: the other end of a pipe, a terminal.
bool nobody_reads();

/// The end of a command that was to print: `exit_code` if all of it has left, kExitBrokenPipe if nobody reads any more,
/// and kExitFailure, with a line on standard error, if it could not be written.
int printed(int exit_code);

}  // namespace barehand
