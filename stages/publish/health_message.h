#pragma once

#include <cstdint>
#include <string>

#include "barehand/health_t.hpp"
#include "core/statistics.h"

namespace barehand {

/// `utime` [us] is the time of the report, `source` FrameSource::name().
health_t health_message(const PipelineHealth& health, std::int64_t utime, const std::string& source);

}  // namespace barehand
