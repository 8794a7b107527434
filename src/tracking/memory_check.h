#pragma once

#include <cstdint>

#include "core/error.h"
#include "tracking/tracker_params.h"

namespace barehand {

/// An error if so many samples are asked for that their pairs do not fit into `available` bytes.
Result<void> check_memory(const TrackerParams& params, std::int64_t available);

}  // namespace barehand
