#pragma once

#include "core/parallel/parallel.h"
#include "observe/sampled/observer.h"
#include "stages/segment_tracker/segment_tracker_params.h"

namespace barehand {

/// Number of samples per parallel task: small enough to balance the load, large enough to outweigh a task's overhead.
inline constexpr int kSampleChunk = 16;

/// The cap on a single pixel's distance (paper, Eq. 1) [m]; infinity if the distance is uncapped.
float distance_cap(const SegmentTrackerParams& params);
/// The first segment that is compared with the data: the palm or, if the palm is not to be observed, the next one.
inline int first_compared(const SegmentTrackerParams& params) { return params.observe_palm ? kPalm : kPalm + 1; }

/// Compares samples with the data on the CPU. `workers` must outlive this object; results do not depend on their
/// number.
class CpuObserver final : public Observer {
 public:
  CpuObserver(float cap, Workers& workers) : cap_(cap), workers_(workers) {}
  void compare(const SampleBatch& batch, PatchDistances& distances) override;

 private:
  float cap_;
  Workers& workers_;
};

}  // namespace barehand
