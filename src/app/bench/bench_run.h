#pragma once

#include "app/bench/bench_options.h"

namespace barehand {

/// Runs `barehand bench` and returns its exit code (exit_code.h).
int run_bench(const BenchOptions& options);

}  // namespace barehand
