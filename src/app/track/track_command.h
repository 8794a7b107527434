#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace barehand {

struct TrackOptions;

/// Adds the options that say which frames are tracked, how, and which hands: from --source to --init.
void add_input_options(CLI::App& command, TrackOptions& options);

/// Adds the option `name`, which may be repeated: the origins of other web pages that may connect.
void add_origin_option(CLI::App& command, const std::string& name, std::vector<std::string>& origins);

/// Adds the options of the live page. The calibrate command has the same ones.
void add_view_options(CLI::App& command, TrackOptions& options);

/// Adds `barehand track`, the daemon. After it has run, `exit_code` holds its result (exit_code.h).
void add_track_command(CLI::App& app, int& exit_code);

}  // namespace barehand
