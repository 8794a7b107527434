#pragma once

#include <string>
#include <vector>

#include "app/bench_case.h"

namespace barehand {

/// Names of the parameters that can be swept, for help and messages.
std::string sweep_names();

/// Cases that differ from `base` in one parameter: "samples=20,60,120". Errors: an unknown parameter, something that is
/// no number, a value out of range.
Result<std::vector<BenchCase>> parse_sweep(const std::string& text, const BenchCase& base);

}  // namespace barehand
