#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds the command `barehand calibrate`, which turns a recording of a hand that is turned and bent before the sensor
/// into a hand profile. After it has run, `exit_code` holds its result (exit_code.h).
void add_calibrate_command(CLI::App& app, int& exit_code);

}  // namespace barehand
