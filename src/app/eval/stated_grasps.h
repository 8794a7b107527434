#pragma once

#include <string>

#include "core/error.h"
#include "evaluation/grasp_evaluation.h"

namespace barehand {

/// The grasps of all grasp_state_t in an LCM log or MCAP file, as `track --states-log` and `--mcap` write them. Errors:
/// the log cannot be read, holds no such state, or holds states of two hands.
Result<StatedGrasps> read_stated_grasps(const std::string& log_path);

}  // namespace barehand
