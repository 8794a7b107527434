#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds the command `barehand scan-object`, which saves the shape of an object that a hand turns in front of the sensor
/// as a mesh for `track --object`. After it has run, `exit_code` holds its result (exit_code.h).
void add_scan_command(CLI::App& app, int& exit_code);

}  // namespace barehand
