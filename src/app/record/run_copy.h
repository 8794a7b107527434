#pragma once

#include <cstdint>
#include <string>

#include "app/shared/source_factory.h"

namespace CLI {
class App;
}

namespace barehand {

/// A request to copy frames from a source into a log or folder, as `record` and `convert` do.
struct CopyRequest {
  SourceRequest source;
  std::string config;  ///< configuration for sensor, depth range and intrinsics, unless `source` gives them; "": none
  std::string out, out_option = "--out";  ///< path of the output; its option in messages
  std::string colour = "png";             ///< png, jpeg, raw, none
  std::string depth = "rvl";              ///< rvl, zlib, raw
  int jpeg_quality = 92;
  std::string out_channel = "RGBD_FRAME";
  bool overwrite = false;
  std::int64_t frames = 0;
  double seconds = 0;
  std::uint64_t max_size = 0, quota = 0;  ///< largest size of one file and of all files [bytes]; 0: no limit
  double max_age = 0;                     ///< longest time in one file [s]; 0: no limit
};

/// Copies until the source ends, a limit is reached or Ctrl-C is pressed; returns the exit code. Messages on standard
/// error start with `command`.
int run_copy(const CopyRequest& request, const std::string& command);

/// Adds the options that both commands have.
void add_copy_options(CLI::App& command, CopyRequest& request);

}  // namespace barehand
