#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds the command `barehand view`, which shows the states sent by another tracker, or a log. After it has run,
/// `exit_code` holds its result (exit_code.h).
void add_view_command(CLI::App& app, int& exit_code);

}  // namespace barehand
