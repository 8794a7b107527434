#pragma once

#include <benchmark/benchmark.h>

#include <memory>

#include "benchmarks/world.h"
#include "stages/fusion/fusion.h"
#include "stages/segment_tracker/segment_tracker.h"

namespace barehand::bench {

/// The first level of sampling for the frame of world(), with samples of all segments, on one core. The benchmark's
/// first argument is the number of samples per segment.
struct Level {
  explicit Level(const benchmark::State& state) {
    SegmentTrackerParams params = w.tracker.segment_tracker;
    params.samples = static_cast<int>(state.range(0));
    tracker = std::make_unique<SegmentTracker>(params, w.surface, workers);
    prepared = tracker->prepare(*w.observation, w.predicted);
    proposals = fusion.first_proposals(w.predicted);
    samples = draw();
  }
  const SegmentSamples& draw() { return tracker->sample(prepared, proposals, {1, 1, 0, 6}); }
  /// Number of samples of all segments in all iterations of the benchmark.
  static std::int64_t drawn(const benchmark::State& state) {
    return state.iterations() * state.range(0) * kSegmentCount;
  }

  const World& w = world();
  Workers workers{1};
  Fusion fusion{w.tracker.fusion, w.profile, workers};
  std::unique_ptr<SegmentTracker> tracker;
  PreparedObservation prepared;
  Proposals proposals;
  SegmentSamples samples;
};

}  // namespace barehand::bench
