#pragma once

#include <memory>

#include "core/parallel/parallel.h"
#include "hand/samples.h"
#include "hand/surface.h"
#include "observe/observation.h"
#include "observe/sampled/observer.h"
#include "stages/segment_tracker/sampling.h"
#include "stages/segment_tracker/segment_tracker_params.h"
#include "stages/segment_tracker/self_occlusion.h"

namespace barehand {

// The local trackers of the segments: samples and their likelihoods (paper, Sec. 4).

/// Data of one frame that all search levels share: the pixel map, which also marks the pixels where the hand hides its
/// own segments at the predicted pose.
struct PreparedObservation {
  PixelMap map;
  std::uint64_t id = 0;                            ///< id of the map, unique within the tracker
  std::array<double, kSegmentCount> unoccluded{};  ///< alpha of the paper's Eq. 3 at the predicted pose
};

/// The 16 local trackers (paper Sec. 4). Each draws samples for its own segment and evaluates them on the data around
/// it.
/// Results depend on the arguments only, not on earlier calls or the number of workers. A returned reference is valid
/// until the same function is called again, because its memory is reused.
class SegmentTracker {
 public:
  /// `observer` compares samples with the data; if none is given, the CPU does. It may be shared with a later tracker.
  SegmentTracker(const SegmentTrackerParams& params, std::shared_ptr<const HandSurface> surface, Workers& workers,
                 std::shared_ptr<Observer> observer = nullptr);

  const SegmentTrackerParams& params() const { return params_; }

  /// Prepares a frame; call once per frame.
  const PreparedObservation& prepare(const HandObservation& observation, const HandPose& predicted);

  /// Draws `count` samples per segment from its kernels (at least one each) and computes log L of the paper's Eq. 3;
  /// call once per level. A segment without observation has a flat likelihood: the palm, if so configured, and hidden
  /// segments, for which alpha is 0.
  const SegmentSamples& sample(const PreparedObservation& prepared, const Proposals& proposals, const SampleKey& key,
                               int count);
  /// Draws S samples per segment (parameter `samples`) and computes log L.
  const SegmentSamples& sample(const PreparedObservation& prepared, const Proposals& proposals, const SampleKey& key) {
    return sample(prepared, proposals, key, params_.samples);
  }

  /// Compares one pose of one segment with the data.
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
