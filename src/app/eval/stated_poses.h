#pragma once

#include <string>

#include "core/error.h"
#include "evaluation/reliability.h"

namespace barehand {

/// Poses and covariances of all hand_state_t with a pose in a log, as `track --states-log` or `--mcap` writes it.
/// Errors: the log cannot be read, holds no such state, or holds states of two hands, invalid numbers or a frame twice.
Result<StatedPoses> read_stated_poses(const std::string& log_path);

}  // namespace barehand
