#pragma once

#include <memory>

#include "core/parallel.h"
#include "hand/samples.h"
#include "hand/surface.h"
#include "observe/observation.h"
#include "observe/observer.h"
#include "stages/segment_tracker/sampling.h"
#include "stages/segment_tracker/segment_tracker_params.h"
#include "stages/segment_tracker/self_occlusion.h"

namespace barehand {

/// One frame as all levels of the local trackers share it: data, and what is hidden at the prediction.
struct PreparedObservation {
  PixelMap map;
  std::uint64_t id = 0;                            ///< of the map, unique within its tracker
  std::array<double, kSegmentCount> unoccluded{};  ///< alpha of Eq. 3 at the predicted pose
};

/// The 16 local trackers of Sec. 4: each draws its own samples and judges them by the data around it alone. What it
/// returns depends on the arguments only, not on earlier calls or the number of workers; references are valid until
/// the same is called again: their memory is kept.
class SegmentTracker {
 public:
  /// `observer` compares the samples with the data; none: the CPU does. It may go on to the next tracker.
  SegmentTracker(const SegmentTrackerParams& params, std::shared_ptr<const HandSurface> surface, Workers& workers,
                 std::shared_ptr<Observer> observer = nullptr);

  const SegmentTrackerParams& params() const { return params_; }

  /// Once per frame.
  const PreparedObservation& prepare(const HandObservation& observation, const HandPose& predicted);

  /// Once per level: `count` samples per segment from its kernels (at least one each) with log L of Eq. 3. A segment
  /// without observation (the palm if so configured; hidden ones, as alpha is 0) has a flat likelihood.
  const SegmentSamples& sample(const PreparedObservation& prepared, const Proposals& proposals, const SampleKey& key,
                               int count);
  /// S of them.
  const SegmentSamples& sample(const PreparedObservation& prepared, const Proposals& proposals, const SampleKey& key) {
    return sample(prepared, proposals, key, params_.samples);
  }

  /// One pose of one segment against the data.
  PatchDistance compare(const PreparedObservation& prepared, int segment, const SE3& T_camera_segment) const;

 private:
  SegmentTrackerParams params_;
  std::shared_ptr<const HandSurface> surface_;
  Workers& workers_;
  std::shared_ptr<Observer> observer_;
  SelfOcclusion self_occlusion_;
  PreparedObservation prepared_;
  SegmentSamples samples_;
  PatchDistances distances_;
};

}  // namespace barehand
