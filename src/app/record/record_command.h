#pragma once

namespace CLI {
class App;
}

namespace barehand {

/// Adds `barehand record`, which writes frames from any source into an LCM log, an MCAP file or a recording folder.
/// After it has run, `exit_code` holds its result (exit_code.h).
void add_record_command(CLI::App& app, int& exit_code);

}  // namespace barehand
