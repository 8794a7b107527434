#pragma once

#include <cstdint>
#include <optional>

#include "hand/hand_pose.h"
#include "observe/observation.h"
#include "stages/refinement/pose_uncertainty.h"
#include "tracking/hypotheses/hypothesis.h"
#include "tracking/person_model.h"

namespace barehand {

// Builds the published estimate of a hand from the tracker's pose.

/// The ids that a tracker gives to the hands that it finds: `first`, then `step` more for each new hand, so that two
/// trackers never give the same id.
struct HandIds {
  std::int32_t first = 1, step = 1;
};

/// Builds the estimate of a frame: which segments are seen, their velocities, covariances and confidences. While the
/// hand is held or lost, the estimate repeats the pose of the last tracked frame.
class EstimateBuilder {
 public:
  EstimateBuilder(const TrackerContext& context, HandIds ids);

  /// Gives the hand a new id, because a new track begins.
  void start_track();
  /// Continues with the changed parameters of the context.
  void change();
  /// The id of the hand that is tracked, or was tracked last.
  std::int32_t hand_id() const { return hand_id_; }
  /// Forgets the last tracked pose.
  void reset() { last_tracked_.reset(); }

  /// `chosen`: the pose of this frame; null: there is none. It is used only if `status` is tracking. `bad`: its score
  /// is that of a bad frame, so that the hand may be in another pose, or elsewhere. `ambiguous`: of an ambiguous one.
  HandEstimatePtr build(const HandObservation& observation, TrackStatus status, const Hypothesis* chosen, bool bad,
                        bool ambiguous, const PersonModel& person, Decisions decisions);

 private:
  void fill_segments(HandEstimate& out, const Hypothesis& chosen, bool bad, double size_in_view);
  void fill_held(HandEstimate& out) const;

  const TrackerContext& context_;
  PoseUncertainty uncertainty_;
  const HandIds ids_;
  std::int32_t hand_id_ = 0;
  HandEstimatePtr last_tracked_;
};

}  // namespace barehand
