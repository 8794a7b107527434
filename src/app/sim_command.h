#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds `barehand sim`: renders a sequence of a simulated hand with truth. When it has run, `exit_code` holds 0, 1
/// after an error while writing, 2 if nothing could be started; errors stand on stderr.
void add_sim_command(CLI::App& app, int& exit_code);

}  // namespace barehand
