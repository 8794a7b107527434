#pragma once

#include <cstdint>
#include <string>

#include "app/shared/source_factory.h"

namespace CLI {
class App;
}

namespace barehand {

/// What `record` and `convert` have in common: frames from a source into a log or folder.
struct CopyRequest {
  SourceRequest source;
  std::string config;  ///< its groups foreign_camera and openni2 hold where `source` gives no intrinsics; "": none
  std::string out, out_option = "--out";  ///< its path; how messages call it
  std::string colour = "png";             ///< png, jpeg, raw, none
  std::string depth = "rvl";              ///< rvl, zlib, raw
  int jpeg_quality = 92;
  std::string out_channel = "RGBD_FRAME";
  bool overwrite = false;
  std::int64_t frames = 0;
  double seconds = 0;
  std::uint64_t max_size = 0, quota = 0;  ///< [bytes] of one file, of all; 0: no limit
  double max_age = 0;                     ///< [s] of one file; 0: no limit
};

/// Runs it to the end, a limit or Ctrl-C; returns the exit code. `command` starts the messages on standard error.
int run_copy(const CopyRequest& request, const std::string& command);

/// The options that both commands have.
void add_copy_options(CLI::App& command, CopyRequest& request);

}  // namespace barehand
