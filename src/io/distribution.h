#pragma once

#include <cstddef>
#include <vector>

namespace barehand {

/// What a set of errors looks like, in the unit of its values. NaN where there are none.
struct Distribution {
  std::size_t count = 0;
  double mean = 0, deviation = 0;  ///< deviation with n in the denominator
  double min = 0, quartile1 = 0, median = 0, quartile3 = 0, p90 = 0, p95 = 0, max = 0;
};
Distribution summarise(std::vector<double> values);
/// The same in another unit: all values times `scale`.
Distribution scaled(Distribution d, double scale);

/// Linear between the two nearest of the sorted, non-empty values; fraction in [0, 1].
double quantile(const std::vector<double>& sorted, double fraction);

}  // namespace barehand
