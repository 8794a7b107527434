#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds `barehand eval`: results against truth (the paper's metrics), or projected fingertips against labels. When it
/// has run, `exit_code` holds its result (exit_code.h); errors stand on stderr.
void add_eval_command(CLI::App& app, int& exit_code);

}  // namespace barehand
