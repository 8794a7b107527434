#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds `barehand eval`, which compares results with ground truth (the paper's metrics), or projected fingertips with
/// labels. After it has run, `exit_code` holds its result (exit_code.h); errors are printed to stderr.
void add_eval_command(CLI::App& app, int& exit_code);

}  // namespace barehand
