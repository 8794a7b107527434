#pragma once

#include "app/bench/bench_report.h"
#include "pipeline/config.h"

namespace barehand {

/// Times a level's comparison by the CPU and by what runs OpenGL ES, with the configuration's number of samples and
/// with a thousand for every segment. Error: nothing runs OpenGL ES, or the device fails.
Result<std::vector<ObserverRow>> compare_observers(const std::string& name, const Config& config, int threads);

}  // namespace barehand
