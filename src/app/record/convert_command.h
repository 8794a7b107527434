#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds `barehand convert`, which turns a recording (folder, LCM log, MCAP file, .oni file) into another form: folder,
/// LCM log or MCAP file. After it has run, `exit_code` holds its result (exit_code.h).
void add_convert_command(CLI::App& app, int& exit_code);

}  // namespace barehand
