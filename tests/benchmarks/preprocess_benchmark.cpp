#include <benchmark/benchmark.h>

#include "benchmarks/world.h"
#include "stages/preprocess/image/distance_transform.h"
#include "stages/preprocess/preprocess.h"

namespace barehand::bench {
namespace {

void whole_stage(benchmark::State& state) {
  const World& w = world();
  const HandEstimates before = feedback(w);
  Preprocessor preprocessor(w.preprocess);
  for (auto _ : state) benchmark::DoNotOptimize(preprocessor.process(w.frame, before));
}
BENCHMARK(whole_stage)->Name("preprocess")->Unit(benchmark::kMicrosecond);

void masks(benchmark::State& state) {
  const World& w = world();
  const HandEstimates before = feedback(w);
  const SkinModel skin(w.preprocess.learning_rate, w.preprocess.learned_share);

  // Create the units and buffers once, as the preprocessor does.
  CoarseGrid grid;
  HandLocator locator(w.preprocess, 1);
  const StandingDepth standing;
  DepthCleaner cleaner;
  HandMask masker(w.preprocess);
  const HandObservation& o = *w.observation;
  const Region region{o.u0, o.v0, o.depth.width(), o.depth.height()};
  Image<float> depth;
  Image<std::uint8_t> edge, mask;

  // Run all steps up to the mask of the hand.
  for (auto _ : state) {
    sample_coarsely(*w.frame, w.preprocess, skin, grid);
    const std::span<const CoarseHand> hands = locator.find(grid, standing, before, 0.03);
    cleaner.clean(*w.frame, w.preprocess, region, depth, edge);
    masker.compute(*w.frame, skin, grid, hands.front(), hands, region, depth, edge, mask);
    benchmark::DoNotOptimize(mask.data());
  }
}
BENCHMARK(masks)->Unit(benchmark::kMicrosecond);

void distance_transform(benchmark::State& state) {
  const HandObservation& o = *world().observation;
  Image<std::uint8_t> mask(o.label.width(), o.label.height());
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = o.label[i] == PixelLabel::hand;
  NearestPixelTransform transform;
  Image<std::int32_t> nearest;
  for (auto _ : state) transform.compute(mask, nearest);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mask.size()));
}
BENCHMARK(distance_transform)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace barehand::bench
