// The parameters that `barehand bench` can vary, and the cases that follow from them.
#include "app/bench/bench_sweep.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

#include "core/parallel/parallel.h"

namespace barehand {
namespace {

/// A parameter that can be swept: its name, its range and its place in a case.
struct Parameter {
  std::string_view name;
  int lo, hi;
  int& (*of)(BenchCase&);
};

constexpr std::array kParameters = {
    Parameter{"samples", 1, 100000, [](BenchCase& c) -> int& { return c.config.tracker.segment_tracker.samples; }},
    Parameter{"levels", 1, 100, [](BenchCase& c) -> int& { return c.config.tracker.fusion.levels; }},
    Parameter{"points", 10, 5000, [](BenchCase& c) -> int& { return c.config.tracker.skin_points; }},
    Parameter{"iterations", 0, 100, [](BenchCase& c) -> int& { return c.config.tracker.refinement.iterations; }},
    Parameter{"stride", 1, 16, [](BenchCase& c) -> int& { return c.config.tracker.refinement.comparison.stride; }},
    Parameter{"threads", 1, Workers::kMaxThreads, [](BenchCase& c) -> int& { return c.threads; }},
    Parameter{"decimate", 1, 16, [](BenchCase& c) -> int& { return c.decimate; }},
};

/// Parses a value of the parameter.
Result<int> number(const std::string& text, const Parameter& parameter) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || value < parameter.lo || value > parameter.hi)
    return fail("'" + text + "' is not a whole number from " + std::to_string(parameter.lo) + " to " +
                    std::to_string(parameter.hi),
                "--sweep " + std::string(parameter.name), "");
  return value;
}

}  // namespace

std::string sweep_names() {
  std::string names;
  for (const Parameter& p : kParameters) names += (names.empty() ? "" : ", ") + std::string(p.name);
  return names;
}

Result<std::vector<BenchCase>> parse_sweep(const std::string& text, const BenchCase& base) {
  // Find the parameter by its name.
  const auto equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const auto* parameter = std::find_if(kParameters.begin(), kParameters.end(), [&](auto& p) { return p.name == name; });
  if (parameter == kParameters.end() || equals == std::string::npos)
    return fail("not a parameter that can be varied", "--sweep " + text,
                "give NAME=VALUE,VALUE with one of " + sweep_names());

  // Make one case per value.
  std::vector<BenchCase> cases;
  std::istringstream values(text.substr(equals + 1));
  for (std::string value; std::getline(values, value, ',');) {
    const auto parsed = number(value, *parameter);
    if (!parsed) return tl::unexpected(parsed.error());

    // Change this parameter alone.
    cases.push_back(base);
    parameter->of(cases.back()) = *parsed;
    cases.back().sweep = name;
    cases.back().value = *parsed;
  }
  return cases;
}

}  // namespace barehand
