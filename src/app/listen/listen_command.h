#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds `barehand listen`, which prints the hand states on the bus and is an example of a subscriber. After it has run,
/// `exit_code` holds its result (exit_code.h).
void add_listen_command(CLI::App& app, int& exit_code);

}  // namespace barehand
