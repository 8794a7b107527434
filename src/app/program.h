#pragma once

namespace barehand {

/// The command `barehand`: reads its arguments, runs the subcommand, returns the exit code. It is a shared library, so
/// that a package can contain it for several instruction sets and the loader chooses the best one
/// (cmake/instruction_sets.cmake).
int run_program(int argc, char** argv);

}  // namespace barehand
