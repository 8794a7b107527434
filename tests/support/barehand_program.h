#pragma once

#include <string>
#include <vector>

#include "support/child_process.h"

namespace barehand {

/// The result of a run of the `barehand` command.
struct Outcome {
  int exit_code;
  std::string output;  ///< standard output and error
};

/// Runs the program that was built with the tests (BAREHAND_PROGRAM), and waits for its end.
inline Outcome barehand(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), BAREHAND_PROGRAM);
  ChildProcess child(std::move(arguments));
  const int exit_code = child.finish();
  return {exit_code, child.output()};
}

/// Runs a bash script in which $B is the program and $D is `folder`.
inline Outcome script(const std::string& folder, const std::string& text) {
  ChildProcess child({"bash", "-c", "B=" BAREHAND_PROGRAM " D=" + folder + "; " + text});
  const int exit_code = child.finish();
  return {exit_code, child.output()};
}

}  // namespace barehand
