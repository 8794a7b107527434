#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds the command `barehand experiment`, which repeats the paper's experiments on the simulator. After it has run,
/// `exit_code` holds its result (exit_code.h).
void add_experiment_command(CLI::App& app, int& exit_code);

}  // namespace barehand
