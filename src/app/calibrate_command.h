#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// `barehand calibrate`: a hand that is turned and bent before the sensor becomes a hand profile.
void add_calibrate_command(CLI::App& app, int& exit_code);

}  // namespace barehand
