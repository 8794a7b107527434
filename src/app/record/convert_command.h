#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds `barehand convert`: recordings from one form to another, folder, LCM log, MCAP file. When it has run,
/// `exit_code` holds its result (exit_code.h).
void add_convert_command(CLI::App& app, int& exit_code);

}  // namespace barehand
