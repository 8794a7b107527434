#pragma once

#include <cstdint>
#include <optional>

#include "hand/hand_pose.h"
#include "observe/observation.h"
#include "stages/refinement/pose_uncertainty.h"
#include "tracking/hypotheses/hypothesis.h"
#include "tracking/person_model.h"

namespace barehand {

/// The ids that a tracker gives to the hands it finds, one after the other.
struct HandIds {
  std::int32_t first = 1, step = 1;
};

/// Builds the estimate of a frame: which segments are seen, velocities, covariance and confidence, and what is kept of
/// the last tracked frame while the hand is held or lost.
class EstimateBuilder {
 public:
  EstimateBuilder(const TrackerContext& context, HandIds ids);

  /// A new hand gets a new id.
  void start_track();
  /// Continues with the context's new parameters.
  void change();
  /// No hand is known any more.
  void reset() { last_tracked_.reset(); }

  /// `chosen`: the pose of this frame, null: none. It counts only while tracking.
  HandEstimatePtr build(const HandObservation& observation, TrackStatus status, const Hypothesis* chosen,
                        const PersonModel& person, Decisions decisions);

 private:
  void fill_segments(HandEstimate& out, const Hypothesis& chosen, double size_in_view);
  void fill_held(HandEstimate& out) const;

  const TrackerContext& context_;
  PoseUncertainty uncertainty_;
  const HandIds ids_;
  std::int32_t hand_id_ = 0;
  HandEstimatePtr last_tracked_;
};

}  // namespace barehand
