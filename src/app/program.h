#pragma once

namespace barehand {

/// The command `barehand`: reads its arguments, runs the subcommand, returns the exit code. It lives in a shared
/// library, so that a package can ship one build per instruction set and the loader picks the best
/// (cmake/instruction_sets.cmake).
int run_program(int argc, char** argv);

}  // namespace barehand
