#pragma once

#include <string>

#include "app/progress.h"
#include "core/statistics.h"

namespace barehand {

/// The closing report of a run, for people: frames, track status, drops, times per stage in milliseconds.
std::string summary(const PipelineHealth& health, const StatusCounts& status, double seconds);
/// One line on how the pipeline is doing.
std::string health_line(const PipelineHealth& health);

}  // namespace barehand
