#include <benchmark/benchmark.h>

#include "benchmarks/world.h"
#include "stages/refinement/refinement.h"

namespace barehand::bench {
namespace {

CellGrid cells() { return grid_of(*world().observation, world().tracker.refinement.comparison.stride); }

RenderedHand rendered_hand() {
  const World& w = world();
  RenderedHand rendered;
  render_hand(*w.skin, w.predicted, w.frame->camera, cells(), rendered);
  return rendered;
}

void rendering(benchmark::State& state) {
  const World& w = world();
  RenderedHand rendered;
  for (auto _ : state) render_hand(*w.skin, w.predicted, w.frame->camera, cells(), rendered);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(w.skin->triangles.size()));
}
BENCHMARK(rendering)->Unit(benchmark::kMicrosecond);

void comparison(benchmark::State& state) {
  const World& w = world();
  const RenderedHand rendered = rendered_hand();
  ModelComparison out;
  for (auto _ : state) compare(*w.observation, *w.skin, w.predicted, rendered, w.tracker.refinement.comparison, out);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rendered.depth.size()));
}
BENCHMARK(comparison)->Unit(benchmark::kMicrosecond);

void data_terms(benchmark::State& state) {
  const World& w = world();
  const RenderedHand rendered = rendered_hand();
  ModelComparison evidence;
  compare(*w.observation, *w.skin, w.predicted, rendered, w.tracker.refinement.comparison, evidence);
  GaussianTree tree;
  tree.set_zero();
  for (auto _ : state)
    benchmark::DoNotOptimize(add_data_terms(*w.skin, w.predicted, evidence, w.tracker.refinement.energy, {}, tree));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(evidence.correspondences.size()));
}
BENCHMARK(data_terms)->Unit(benchmark::kMicrosecond);

/// The whole refinement with n Gauss-Newton steps; the difference between two n is the time of a step.
void gauss_newton(benchmark::State& state) {
  const World& w = world();
  Refinement refinement(w.tracker.refinement, w.profile, w.skin);
  const int steps = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(refinement.refine(*w.observation, w.predicted, w.predicted, steps));
}
BENCHMARK(gauss_newton)->Arg(1)->Arg(5)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace barehand::bench
