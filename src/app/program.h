#pragma once

namespace barehand {

/// The command `barehand`: reads its arguments, runs the subcommand, returns the exit code. It is a shared library, so
/// that a package can hold it for several instruction sets and the loader takes the best
/// (cmake/instruction_sets.cmake).
int run_program(int argc, char** argv);

}  // namespace barehand
