#pragma once

#include <cstdint>

#include "core/error.h"
#include "tracking/tracker_params.h"

namespace barehand {

/// Returns an error if the memory for all pairs of samples (belief propagation) exceeds `available` bytes.
Result<void> check_memory(const TrackerParams& params, std::int64_t available);

}  // namespace barehand
