#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace barehand {

/// Durations in seconds; NaN where nothing was recorded.
struct TimeSummary {
  std::int64_t count = 0;
  double mean = 0, p50 = 0, p95 = 0, p99 = 0, max = 0;
};

/// Distribution of durations in fixed memory: 16 buckets per octave from 1 us to 2^36 us (19 hours), so percentiles are
/// within 5 % (below 16 us: within 1 us); mean and maximum are exact.
class TimeHistogram {
 public:
  /// Microseconds; negative ones (a clock that was set back) count as 0.
  void add(std::int64_t duration_us);
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

/// Counts since the start of the run; pushed = popped + dropped + depth.
struct QueueHealth {
  std::string name;
  std::size_t capacity = 0, depth = 0;
  std::int64_t pushed = 0, popped = 0, dropped = 0;
  TimeSummary wait;  ///< how long items stood in it; no count where nobody measured
};

/// One stage: how long it took per frame, and how many frames it failed on.
struct StageHealth {
  std::string name;
  TimeSummary time;
  std::int64_t failed = 0;
};

/// The whole pipeline. Between frames captured = published + dropped + failed; while frames are on their way the
/// difference is what is in flight.
struct PipelineHealth {
  std::int64_t captured = 0;   ///< frames the source delivered
  std::int64_t published = 0;  ///< frames that passed every stage
  std::int64_t dropped = 0;    ///< at the door, because the tracker was slow
  std::int64_t failed = 0;     ///< frames on which a stage failed
  std::int64_t skipped = 0;    ///< frames the source could not read; not part of `captured`
  TimeSummary latency;         ///< capture to published; of a replay: read to published
  std::vector<StageHealth> stages;
  std::vector<QueueHealth> queues;  ///< in the order frames pass them, those of the source first
};

}  // namespace barehand
