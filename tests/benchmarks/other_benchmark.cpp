#include <benchmark/benchmark.h>

#include "benchmarks/world.h"
#include "drivers/lcm/wire.h"
#include "stages/prediction/motion_prediction.h"
#include "stages/publish/hand_messages.h"
#include "stages/search/coarse_score.h"

namespace barehand::bench {
namespace {

/// ICP, and the candidates that the prediction stage makes from its result.
void prediction(benchmark::State& state) {
  const World& w = world();
  MotionModel motion(w.tracker.prediction, w.tracker.icp);
  motion.restart(w.predicted, w.frame->utime - 33'000);
  for (auto _ : state) benchmark::DoNotOptimize(motion.predict(*w.observation, *w.surface));
}
BENCHMARK(prediction)->Unit(benchmark::kMicrosecond);

/// Scores one pose of a search from templates.
void coarse_score(benchmark::State& state) {
  const World& w = world();
  const CoarseSkin skin =
      make_coarse_skin(*w.profile, make_cylinder_surface(*w.profile, 600), w.tracker.initialiser.fine_cell);
  const ScoreGrid grid = make_score_grid(*w.observation, w.tracker.initialiser.fine_cell);
  CoarseScorer score(grid, skin, w.tracker.initialiser.score);
  for (auto _ : state) benchmark::DoNotOptimize(score(w.predicted));
}
BENCHMARK(coarse_score)->Unit(benchmark::kMicrosecond);

void lcm_encode(benchmark::State& state) {
  const HandEstimate estimate = earlier_estimate(world());
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
