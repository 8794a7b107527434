#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/error.h"

namespace barehand {

/// What `barehand sim` should write.
struct SimOptions {
  std::string spec;        ///< "NAME" or "NAME,key=value,...", as after "sim:" in --source
  std::string out;         ///< folder, or an LCM log or MCAP file if it ends with .lcmlog or .mcap
  bool overwrite = false;  ///< replace a log and the files next to it
};

/// Renders a whole sequence. A folder becomes a recording (docs/formats.md) with truth.csv, hand.json and, if the hand
/// is visible in the first frame, start_pose.json; a second hand adds truth_left.csv and so on. Where an object is
/// grasped there are objects.csv, contacts.csv, grasps.csv and the object's mesh. A log gets the frames on the channel
/// RGBD_FRAME, and the same files are written next to it with the log's name in front (LOG.truth.csv). `progress(done,
/// all)` is called after each frame; if it returns false, the run ends, and what was written is complete. Returns the
/// number of frames written. Errors: a wrong specification, an output that exists already, a full disk.
Result<std::int64_t> run_sim(const SimOptions& options,
                             const std::function<bool(std::int64_t, std::int64_t)>& progress);

}  // namespace barehand
