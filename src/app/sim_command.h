#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds `barehand sim`: renders a sequence of a simulated hand with truth. When it has run, `exit_code` holds its
/// result (exit_code.h); errors stand on stderr.
void add_sim_command(CLI::App& app, int& exit_code);

}  // namespace barehand
