#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds the command `barehand calibrate`, which measures the profile of a hand that is turned and bent in front of the
/// sensor, live or in a recording. After it has run, `exit_code` holds its result (exit_code.h).
void add_calibrate_command(CLI::App& app, int& exit_code);

}  // namespace barehand
