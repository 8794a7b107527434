// Computes summary statistics of a set of values.
#include "evaluation/distribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace barehand {

double quantile(const std::vector<double>& sorted, double fraction) {
  assert(!sorted.empty() && fraction >= 0 && fraction <= 1);
  const double position = fraction * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}

Distribution summarise(std::vector<double> values) {
  // Without values there are no statistics.
  if (values.empty()) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {0, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};
  }

  // Compute the moments.
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  Distribution d;
  d.count = values.size();
  d.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0;
  for (double value : values) squares += (value - d.mean) * (value - d.mean);
  d.deviation = std::sqrt(squares / count);

  // Compute the order statistics.
  d.min = values.front();
  d.quartile1 = quantile(values, 0.25);
  d.median = quantile(values, 0.5);
  d.quartile3 = quantile(values, 0.75);
  d.p90 = quantile(values, 0.9);
  d.p95 = quantile(values, 0.95);
  d.max = values.back();
  return d;
}

Distribution scaled(Distribution d, double scale) {
  for (double* value : {&d.mean, &d.deviation, &d.min, &d.quartile1, &d.median, &d.quartile3, &d.p90, &d.p95, &d.max})
    *value *= scale;
  return d;
}

}  // namespace barehand
