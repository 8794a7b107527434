#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds `barehand convert`, which turns a recording folder or an .oni file into an LCM log, or a log or an .oni file
/// into a folder. After it has run, `exit_code` holds its result (exit_code.h).
void add_convert_command(CLI::App& app, int& exit_code);

}  // namespace barehand
