#include "benchmarks/level.h"
#include "observe/egl/egl_observer.h"
#include "stages/segment_tracker/cpu_observer.h"

namespace barehand::bench {
namespace {

SampleBatch batch_of(const Level& level, std::uint64_t map_id) {
  return {level.w.surface, level.prepared.map, map_id, level.samples.poses};
}

void compare_on_cpu(benchmark::State& state) {
  const Level level(state);
  Workers workers(static_cast<int>(state.range(1)));
  CpuObserver observer(distance_cap(level.w.tracker.segment_tracker), workers);
  PatchDistances distances;
  for (auto _ : state) observer.compare(batch_of(level, 0), distances);
  state.SetItemsProcessed(Level::drawn(state));
}
BENCHMARK(compare_on_cpu)
    ->ArgNames({"S", "threads"})
    ->ArgsProduct({{60, 200, 1000}, {1, 2}})
    ->Unit(benchmark::kMicrosecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// By OpenGL ES, on a GPU if there is one, else in software: the benchmark's label names the renderer. As in tracking,
/// a new observation map is uploaded for each frame, once for all of its levels.
void compare_by_egl(benchmark::State& state) {
  const Level level(state);
  const float cap = distance_cap(level.w.tracker.segment_tracker);
  const auto observer = EglObserver::open(cap, DeviceChoice::any);
  if (!observer) return state.SkipWithError(observer.error().message().c_str());
  state.SetLabel((*observer)->device().renderer);
  const auto levels_per_map = static_cast<std::uint64_t>(level.w.tracker.fusion.levels);
  PatchDistances distances;
  std::uint64_t compared = 0;
  for (auto _ : state)
    if (const auto done = (*observer)->compare(batch_of(level, compared++ / levels_per_map), distances); !done)
      return state.SkipWithError(done.error().message().c_str());
  state.SetItemsProcessed(Level::drawn(state));
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
