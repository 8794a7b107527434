#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace barehand {

// Statistics of durations, queues and stages.

/// Summary of durations in seconds; NaN if nothing was recorded.
struct TimeSummary {
  std::int64_t count = 0;
  double mean = 0, p50 = 0, p95 = 0, p99 = 0, max = 0;
};

/// A histogram of durations in fixed memory. It has 16 buckets per octave from 1 us to 2^36 us (19 hours), so
/// percentiles are accurate to 5 % (to 1 us below 16 us); mean and maximum are exact.
class TimeHistogram {
 public:
  /// Adds a duration in microseconds; negative ones (the clock was set back) count as 0.
  void add(std::int64_t duration_us);
  /// Count, mean, percentiles and maximum of everything added so far.
  TimeSummary summary() const;
  void clear() { *this = {}; }

 private:
  static constexpr int kSubBuckets = 16;
  static constexpr int kOctaves = 33;
  static int bucket_of(std::int64_t duration_us);
  static double middle_of(int bucket);
  double percentile(double fraction) const;

  std::array<std::int64_t, kSubBuckets * kOctaves> counts_{};
  std::int64_t count_ = 0, sum_us_ = 0, max_us_ = 0;
};

/// Counts of a queue since the start of the run; pushed = popped + dropped + depth.
struct QueueHealth {
  std::string name;
  std::size_t capacity = 0, depth = 0;
  std::int64_t pushed = 0, popped = 0, dropped = 0;
  TimeSummary wait;  ///< waiting time of items; a count of 0 if it was not measured
};

/// Health of one stage: its time per frame, and the number of frames on which it failed.
struct StageHealth {
  std::string name;
  TimeSummary time;
  std::int64_t failed = 0;
};

/// Health of the whole pipeline. captured = published + dropped + failed + frames in flight.
struct PipelineHealth {
  std::int64_t captured = 0;   ///< frames that the source delivered
  std::int64_t published = 0;  ///< frames that passed every stage
  std::int64_t dropped = 0;    ///< frames dropped at the input queue because the tracker was slow
  std::int64_t failed = 0;     ///< frames on which a stage failed
  std::int64_t skipped = 0;    ///< frames that the source could not read; not included in `captured`
  TimeSummary latency;         ///< time from capture (for a replay: from reading) to publication of the hands
  std::vector<StageHealth> stages;
  std::vector<QueueHealth> queues;  ///< in the order in which frames pass them, beginning with those of the source
};

}  // namespace barehand
