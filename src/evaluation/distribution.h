#pragma once

#include <cstddef>
#include <vector>

namespace barehand {

/// Summary statistics of a set of values, in their unit. NaN if there are no values.
struct Distribution {
  std::size_t count = 0;
  double mean = 0, deviation = 0;  ///< standard deviation, with n in the denominator
  double min = 0, quartile1 = 0, median = 0, quartile3 = 0, p90 = 0, p95 = 0, max = 0;
};
/// Summarises values in any order.
Distribution summarise(std::vector<double> values);
constexpr double kMillimetre = 1000;  ///< scale from metres to the millimetres of reports
/// Converts statistics to another unit: all of them are multiplied by `scale`.
Distribution scaled(Distribution d, double scale);

/// A quantile by linear interpolation between the two nearest values; `sorted` must not be empty, `fraction` in
/// [0, 1].
double quantile(const std::vector<double>& sorted, double fraction);

}  // namespace barehand
