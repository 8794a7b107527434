#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds `barehand track`, the daemon. After it has run, `exit_code` holds its result (exit_code.h).
void add_track_command(CLI::App& app, int& exit_code);

}  // namespace barehand
