#pragma once

#include <string>

#include "core/statistics.h"
#include "pipeline/progress.h"

namespace barehand {

/// The closing report of a run, for people: frames, track status of each hand, drops, times per stage in milliseconds.
std::string summary(const PipelineHealth& health, const std::vector<StatusCounts>& hands, double seconds);
/// One line on how the pipeline is doing.
std::string health_line(const PipelineHealth& health);

}  // namespace barehand
