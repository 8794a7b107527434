#pragma once

#include <cstdint>
#include <string>

#include "barehand/health_t.hpp"
#include "core/statistics.h"

namespace barehand {

/// The pipeline's health as a message. `utime`: the time of the report [us]. `source`: FrameSource::name().
health_t health_message(const PipelineHealth& health, std::int64_t utime, const std::string& source);

}  // namespace barehand
