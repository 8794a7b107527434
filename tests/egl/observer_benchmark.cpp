// Samples per second of the observers on one level's samples of all 16 segments, 100 skin points each.
#include <benchmark/benchmark.h>

#include "observe/egl/egl_observer.h"
#include "stages/segment_tracker/cpu_observer.h"
#include "tests/egl/random_batch.h"

namespace barehand {
namespace {

constexpr float kCap = 0.008f;
constexpr int kSkinPoints = 100, kLevels = 6;

RandomBatch world_of(const benchmark::State& state) {
  return random_batch(1, static_cast<int>(state.range(0)), kSkinPoints);
}

void count_samples(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * kSegmentCount * state.range(0));
}

void by_cpu(benchmark::State& state) {
  const RandomBatch world = world_of(state);
  Workers workers(static_cast<int>(state.range(1)));
  CpuObserver observer(world.surface, kCap, workers);
  PatchDistances distances;
  for (auto _ : state) observer.compare(world.batch(), distances);
  count_samples(state);
}
BENCHMARK(by_cpu)
    ->ArgNames({"S", "threads"})
    ->ArgsProduct({{60, 200, 1000}, {1, 2}})
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// With one new map every kLevels levels, as in a frame.
void by_egl(benchmark::State& state) {
  const RandomBatch world = world_of(state);
  const auto observer = EglObserver::open(*world.surface, kCap, DeviceChoice::any);
  if (!observer) return state.SkipWithError(observer.error().message().c_str());
  state.SetLabel((*observer)->device().renderer);
  PatchDistances distances;
  std::uint64_t level = 0;
  for (auto _ : state)
    if (const auto done = (*observer)->compare(world.batch(level++ / kLevels), distances); !done)
      return state.SkipWithError(done.error().message().c_str());
  count_samples(state);
}
BENCHMARK(by_egl)->ArgName("S")->Arg(60)->Arg(200)->Arg(1000)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
}  // namespace barehand

BENCHMARK_MAIN();
