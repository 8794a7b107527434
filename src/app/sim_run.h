#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/error.h"

namespace barehand {

/// What `barehand sim` writes.
struct SimOptions {
  std::string spec;        ///< "NAME" or "NAME,key=value,...", as after "sim:" in --source
  std::string out;         ///< folder, or an LCM log if it ends with .lcmlog
  bool overwrite = false;  ///< of a log and the files beside it
};

/// Renders a whole sequence. Into a folder: a recording (docs/formats.md) with truth.csv, hand.json and, if the hand is
/// in the first frame, start_pose.json; of a second hand truth_left.csv and so on. Into a log: frames on channel
/// RGBD_FRAME, and those files beside it, with the log's name before theirs (LOG.truth.csv). `progress(done, all)` is
/// called after each frame; false from it ends the run, and what is written until then is complete. Returns the number
/// of frames written. Errors: those of the specification, an output that is there already, a disk that is full.
Result<std::int64_t> run_sim(const SimOptions& options,
                             const std::function<bool(std::int64_t, std::int64_t)>& progress);

}  // namespace barehand
