#include "benchmarks/level.h"
#include "stages/segment_tracker/patch_distance.h"

namespace barehand::bench {
namespace {

/// Number of pairs of samples of neighbouring segments.
std::int64_t pairs(const Level& level) {
  const auto n = static_cast<std::int64_t>(level.samples.poses[0].size());
  return n * n;
}

void prepare(benchmark::State& state) {
  const Level level(state);
  for (auto _ : state) benchmark::DoNotOptimize(&level.tracker->prepare(*level.w.observation, level.w.predicted));
}
BENCHMARK(prepare)->Arg(60)->Unit(benchmark::kMicrosecond);

void sampling(benchmark::State& state) {
  Level level(state);
  for (auto _ : state) benchmark::DoNotOptimize(&level.draw());
  state.SetItemsProcessed(Level::drawn(state));
}
BENCHMARK(sampling)->Arg(20)->Arg(60)->Arg(180)->Arg(1000)->Unit(benchmark::kMicrosecond);

void distance_of_a_patch(benchmark::State& state) {
  const Level level(state);
  const int s = segment_of(2, 1);
  const auto& skin = (*level.w.surface)[s];
  std::size_t i = 0;
  for (auto _ : state) {
    i = i + 1 < level.samples.poses[s].size() ? i + 1 : 0;
    benchmark::DoNotOptimize(patch_distance(skin, level.samples.poses[s][i], s, level.prepared.map, 0.008f));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(skin.size()));
}
BENCHMARK(distance_of_a_patch)->Arg(60);

void psi_matrix(benchmark::State& state) {
  const Level level(state);
  const JointModels joints = make_joint_models(*level.w.profile, level.w.tracker.fusion);
  const int s = segment_of(2, 1);
  ParentFrames frames;
  EdgeEnergy energy;
  for (auto _ : state) {
    frames.reset(joints[s], level.samples.poses[parent_of(s)]);
    joint_energy(joints[s], 0.005, frames, level.samples.poses[s], energy);
    benchmark::DoNotOptimize(energy.value.data());
  }
  state.SetItemsProcessed(state.iterations() * pairs(level));
}
BENCHMARK(psi_matrix)->Arg(20)->Arg(60)->Arg(180)->Unit(benchmark::kMicrosecond);

/// Belief propagation as a whole: the psi matrices and all messages of the tree.
void fusing(benchmark::State& state) {
  Level level(state);
  for (auto _ : state) benchmark::DoNotOptimize(&level.fusion.fuse(level.samples, 0));
  state.SetItemsProcessed(state.iterations() * pairs(level) * (kSegmentCount - 1));
}
BENCHMARK(fusing)->Arg(20)->Arg(60)->Arg(180)->Arg(1000)->Unit(benchmark::kMicrosecond);

void next_proposals(benchmark::State& state) {
  Level level(state);
  const HandBelief belief = level.fusion.fuse(level.samples, 0);
  for (auto _ : state) benchmark::DoNotOptimize(&level.fusion.next_proposals(level.samples, belief, 0));
}
BENCHMARK(next_proposals)->Arg(60)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace barehand::bench
