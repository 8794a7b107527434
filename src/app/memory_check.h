#pragma once

#include <cstdint>

#include "app/tracker_params.h"
#include "core/error.h"

namespace barehand {

/// An error if so many samples are asked for that their pairs do not fit into `available` bytes.
Result<void> check_memory(const TrackerParams& params, std::int64_t available);

}  // namespace barehand
