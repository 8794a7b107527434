#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds the command `barehand bench`, which measures the speed of `barehand track`. After it has run, `exit_code`
/// holds its result (exit_code.h).
void add_bench_command(CLI::App& app, int& exit_code);

}  // namespace barehand
