#pragma once

#include "app/bench/bench_report.h"
#include "pipeline/config.h"

namespace barehand {

/// Times how long the CPU and an OpenGL ES device take to compare the samples of one level with the depth image: with
/// the configuration's number of samples per segment, and with at least a thousand. Errors: there is no device, or it
/// fails.
Result<std::vector<ObserverRow>> compare_observers(const std::string& name, const Config& config, int threads);

}  // namespace barehand
