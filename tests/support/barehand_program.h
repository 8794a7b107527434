#pragma once

#include <string>
#include <vector>

#include "support/child_process.h"

namespace barehand {

/// What a run of the `barehand` command left behind.
struct Outcome {
  int exit_code;
  std::string output;  ///< standard output and error
};

/// Runs the program that was built with the tests (BAREHAND_PROGRAM) to its end.
inline Outcome barehand(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), BAREHAND_PROGRAM);
  ChildProcess child(std::move(arguments));
  const int exit_code = child.finish();
  return {exit_code, child.output()};
}

/// Runs a script of bash that knows $B, the program, and $D, `folder`.
inline Outcome script(const std::string& folder, const std::string& text) {
  ChildProcess child({"bash", "-c", "B=" BAREHAND_PROGRAM " D=" + folder + "; " + text});
  const int exit_code = child.finish();
  return {exit_code, child.output()};
}

}  // namespace barehand
