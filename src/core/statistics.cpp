#include "core/statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace barehand {

// The histogram's bucket for a duration. Durations below 16 us have a bucket each. Above, the leading bit selects the
// octave, and the four bits after it select the bucket.
int TimeHistogram::bucket_of(std::int64_t duration_us) {
  const auto value = static_cast<std::uint64_t>(duration_us);
  if (value < kSubBuckets) return static_cast<int>(value);
  const int octave = static_cast<int>(std::bit_width(value)) - 5;
  const int bucket = (octave + 1) * kSubBuckets + static_cast<int>((value >> octave) - kSubBuckets);
  return std::min(bucket, kSubBuckets * kOctaves - 1);
}

/// The duration in the middle of a bucket [us].
double TimeHistogram::middle_of(int bucket) {
  if (bucket < kSubBuckets) return bucket;
  const int octave = bucket / kSubBuckets - 1;
  return std::ldexp(kSubBuckets + bucket % kSubBuckets + 0.5, octave);
}

void TimeHistogram::add(std::int64_t duration_us) {
  duration_us = std::max<std::int64_t>(duration_us, 0);
  ++counts_[bucket_of(duration_us)];
  ++count_;
  sum_us_ += duration_us;
  max_us_ = std::max(max_us_, duration_us);
}

double TimeHistogram::percentile(double fraction) const {
  const auto rank = static_cast<std::int64_t>(std::ceil(fraction * count_));
  std::int64_t seen = 0;
  for (int bucket = 0; bucket < static_cast<int>(counts_.size()); ++bucket) {
    seen += counts_[bucket];
    if (seen >= rank) return std::min(middle_of(bucket), static_cast<double>(max_us_)) * 1e-6;
  }
  return max_us_ * 1e-6;
}

TimeSummary TimeHistogram::summary() const {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (count_ == 0) return {0, kNaN, kNaN, kNaN, kNaN, kNaN};
  return {count_, sum_us_ * 1e-6 / count_, percentile(0.50), percentile(0.95), percentile(0.99), max_us_ * 1e-6};
}

}  // namespace barehand
