#include <benchmark/benchmark.h>

#include "benchmarks/world.h"
#include "observe/egl/egl_observer.h"
#include "stages/fusion/fusion.h"
#include "stages/segment_tracker/cpu_observer.h"
#include "stages/segment_tracker/segment_tracker.h"

namespace barehand::bench {
namespace {

/// The first level's samples of all segments; their number per segment is the benchmark's first argument.
struct Samples {
  explicit Samples(const benchmark::State& state) {
    SegmentTrackerParams params = w.tracker.segment_tracker;
    params.samples = static_cast<int>(state.range(0));
    params.observer = "cpu";
    const SegmentTracker tracker(params, w.surface, workers);
    prepared = tracker.prepare(*w.observation, w.predicted);
    const Fusion fusion(w.tracker.fusion, w.profile, workers);
    poses = tracker.sample(prepared, fusion.first_proposals(w.predicted), {1, 1, 0, 6}).poses;
    cap = distance_cap(params);
  }
  SampleBatch batch(std::uint64_t map_id = 0) const { return {prepared.map, map_id, poses}; }
  void count(benchmark::State& state) const {
    state.SetItemsProcessed(state.iterations() * state.range(0) * kSegmentCount);
  }

  const World& w = world();
  Workers workers{1};
  PreparedObservation prepared;
  std::array<std::vector<SE3>, kSegmentCount> poses;
  float cap = 0;
};

void compare_on_cpu(benchmark::State& state) {
  const Samples samples(state);
  Workers workers(static_cast<int>(state.range(1)));
  CpuObserver observer(samples.w.surface, samples.cap, workers);
  PatchDistances distances;
  for (auto _ : state) observer.compare(samples.batch(), distances);
  samples.count(state);
}
BENCHMARK(compare_on_cpu)
    ->ArgNames({"S", "threads"})
    ->ArgsProduct({{60, 200, 1000}, {1, 2}})
    ->Unit(benchmark::kMicrosecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// A GPU where there is one, else software: the label says which. A new map comes with every frame.
void compare_by_egl(benchmark::State& state) {
  const Samples samples(state);
  const auto observer = EglObserver::open(*samples.w.surface, samples.cap, DeviceChoice::any);
  if (!observer) return state.SkipWithError(observer.error().message().c_str());
  state.SetLabel((*observer)->device().renderer);
  const auto levels = static_cast<std::uint64_t>(samples.w.tracker.fusion.levels);
  PatchDistances distances;
  std::uint64_t level = 0;
  for (auto _ : state)
    if (const auto done = (*observer)->compare(samples.batch(level++ / levels), distances); !done)
      return state.SkipWithError(done.error().message().c_str());
  samples.count(state);
}
BENCHMARK(compare_by_egl)
    ->ArgName("S")
    ->Arg(60)
    ->Arg(200)
    ->Arg(1000)
    ->Unit(benchmark::kMicrosecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace barehand::bench
