// Times the comparison of samples with the depth image on the CPU and on a GPU.
#include "app/bench/bench_observers.h"

#include <algorithm>

#include "observe/egl/egl_observer.h"
#include "pipeline/trial_level.h"
#include "stages/segment_tracker/cpu_observer.h"

namespace barehand {

Result<std::vector<ObserverRow>> compare_observers(const std::string& name, const Config& config, int threads) {
  constexpr int kMany = 1000;
  const SegmentTrackerParams& params = config.tracker.segment_tracker;
  const auto device = EglObserver::open(distance_cap(params), DeviceChoice::any);
  if (!device) return tl::unexpected(device.error());
  Workers workers(threads);
  std::vector<ObserverRow> rows;
  for (const int per_segment : {params.samples, std::max(kMany, params.samples_on_device)}) {
    const auto trial = time_trial_level(config, per_segment, **device, workers);
    if (!trial) return tl::unexpected(trial.error());
    rows.push_back({name, threads, (*device)->device(), *trial});
  }
  return rows;
}

}  // namespace barehand
