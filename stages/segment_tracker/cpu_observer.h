#pragma once

#include "core/parallel.h"
#include "observe/observer.h"
#include "stages/segment_tracker/segment_tracker_params.h"

namespace barehand {

/// Samples per task: small enough to balance, large enough to be worth a task.
inline constexpr int kSampleChunk = 16;

/// Largest distance of one pixel [m] (Eq. 1); infinity: uncapped.
float distance_cap(const SegmentTrackerParams& params);
/// The first segment that is compared with the data.
inline int first_compared(const SegmentTrackerParams& params) { return params.observe_palm ? kPalm : kPalm + 1; }

/// Compares on the cores of `workers`, which outlive it; results do not depend on their number.
class CpuObserver final : public Observer {
 public:
  CpuObserver(float cap, Workers& workers) : cap_(cap), workers_(workers) {}
  void compare(const SampleBatch& batch, PatchDistances& distances) override;

 private:
  float cap_;
  Workers& workers_;
};

}  // namespace barehand
