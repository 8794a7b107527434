#pragma once

#include <string>

#include "core/error.h"
#include "evaluation/reliability.h"

namespace barehand {

/// Poses and covariances of all hand_state_t with a pose in an LCM log, as `track --states-log` writes it. Error: the
/// log cannot be read, or has none, or those of two hands.
Result<StatedPoses> read_stated_poses(const std::string& log_path);

}  // namespace barehand
