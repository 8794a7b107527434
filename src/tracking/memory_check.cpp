#include "tracking/memory_check.h"

#include <cmath>

#include "stages/fusion/fusion.h"

namespace barehand {

Result<void> check_memory(const TrackerParams& params, std::int64_t available) {
  const SegmentTrackerParams& tracker = params.segment_tracker;
  const bool more_on_device = tracker.observer != "cpu" && tracker.samples_on_device > tracker.samples;
  const std::int64_t samples = more_on_device ? tracker.samples_on_device : tracker.samples;
  const std::int64_t needed = Fusion::memory(samples);
  if (!params.sampling || needed <= available) return {};
  const auto megabytes = [](std::int64_t bytes) { return std::to_string(bytes >> 20) + " MiB"; };
  const double fit = std::sqrt(static_cast<double>(available) / static_cast<double>(Fusion::memory(1)));
  return fail(std::to_string(samples) + " samples take " + megabytes(needed) + " of memory in pairs, " +
                  megabytes(available) + " are available",
              more_on_device ? "tracker.segment_tracker.samples_on_device" : "tracker.segment_tracker.samples",
              "give at most " + std::to_string(static_cast<std::int64_t>(fit)));
}

}  // namespace barehand
