#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds `barehand listen`, which prints hand states from the bus: a subscriber to look at and to copy. When it has run,
/// `exit_code` holds its result (exit_code.h).
void add_listen_command(CLI::App& app, int& exit_code);

}  // namespace barehand
