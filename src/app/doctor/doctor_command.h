#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds `barehand doctor`, which reports what is missing on this machine and how to fix it. `exit_code` becomes 0, or 1
/// if something that tracking needs is broken; hints and warnings do not count.
void add_doctor_command(CLI::App& app, int& exit_code);

}  // namespace barehand
