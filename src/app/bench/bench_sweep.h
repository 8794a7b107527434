#pragma once

#include <string>
#include <vector>

#include "app/bench/bench_case.h"

namespace barehand {

/// Names of the parameters that can be swept, for help and messages.
std::string sweep_names();

/// The cases that differ from `base` in one parameter; `text` is, for example, "samples=20,60,120". Errors: an unknown
/// parameter, a text that is not a number, a value out of range.
Result<std::vector<BenchCase>> parse_sweep(const std::string& text, const BenchCase& base);

}  // namespace barehand
