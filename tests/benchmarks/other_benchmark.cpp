#include <benchmark/benchmark.h>

#include "benchmarks/world.h"
#include "drivers/lcm/wire.h"
#include "stages/prediction/motion_prediction.h"
#include "stages/publish/hand_messages.h"

namespace barehand::bench {
namespace {

/// ICP and the candidates that follow from it.
void prediction(benchmark::State& state) {
  const World& w = world();
  MotionModel motion(w.tracker.prediction, w.tracker.icp);
  motion.restart(w.predicted, w.frame->utime - 33'000);
  for (auto _ : state) benchmark::DoNotOptimize(motion.predict(*w.observation, *w.surface));
}
BENCHMARK(prediction)->Unit(benchmark::kMicrosecond);

void lcm_encode(benchmark::State& state) {
  const HandEstimate estimate = hint(world());
  HandMessageMaker maker({});
  for (auto _ : state) {
    const HandMessages messages = maker.process(estimate);
    benchmark::DoNotOptimize(encode_message(messages.state));
    benchmark::DoNotOptimize(encode_message(messages.glove));
    benchmark::DoNotOptimize(encode_message(messages.joints));
  }
}
BENCHMARK(lcm_encode)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace barehand::bench
