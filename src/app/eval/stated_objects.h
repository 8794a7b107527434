#pragma once

#include <string>

#include "core/error.h"
#include "evaluation/object_evaluation.h"

namespace barehand {

/// The poses of object 1, the first one that was given to `track --object`, of all object_state_t in an LCM log or MCAP
/// file, as `track --states-log` and `--mcap` write them. Empty if the object was never found. Error: a file that
/// cannot be read.
Result<ObjectPoses> read_stated_objects(const std::string& log_path);

}  // namespace barehand
