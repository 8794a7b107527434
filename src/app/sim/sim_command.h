#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds the command `barehand sim`, which renders a sequence of a simulated hand with its truth. After it has run,
/// `exit_code` holds its result (exit_code.h); errors are printed on stderr.
void add_sim_command(CLI::App& app, int& exit_code);

}  // namespace barehand
