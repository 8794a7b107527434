#pragma once

#include <string>

#include "core/statistics.h"
#include "pipeline/progress.h"

namespace barehand {

/// The final report of a run for the user: frames, track status of each hand, drops, times per stage in milliseconds.
std::string summary(const PipelineHealth& health, const std::vector<StatusCounts>& hands, double seconds);
/// One line with the pipeline's counters, the median times of its stages and the state of its queues.
std::string health_line(const PipelineHealth& health);

}  // namespace barehand
