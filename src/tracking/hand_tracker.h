#pragma once

#include <memory>
#include <optional>
#include <span>
#include <variant>

#include "tracking/estimate_builder.h"
#include "tracking/hypotheses/follower.h"
#include "tracking/hypotheses/proposers.h"
#include "tracking/person_model.h"
#include "tracking/track.h"

namespace barehand {

/// What a tracker may be asked to do before its next frame.
struct StartAt {
  HandPose pose;  ///< T_camera_segment; the next observation, if it shows a hand, is tracked from it
};
struct StartAnew {};  ///< forgets the hand and the person, and searches
struct UseProfile {
  std::shared_ptr<const HandProfile> profile;  ///< of another person; tracking starts anew
};
struct UseParams {
  TrackerParams params;  ///< the same hand goes on from its last pose, as fitted to the person so far
};
struct DoubtSize {
  double size;  ///< of the hand in view relative to its profile; said once, and no pose is certain from now on
};
using TrackRequest = std::variant<StartAt, StartAnew, UseProfile, UseParams, DoubtSize>;

/// What others may know of a track between two frames.
struct TrackView {
  TrackStatus status;                          ///< as of the last observation
  bool tentative;                              ///< a lost hand may have been found; the next frame must confirm it
  bool doubts_size;                            ///< the hand in view seems to be of another size than the profile's
  bool start_is_given;                         ///< a pose from outside waits for the next observation
  const HandPose* whereabouts;                 ///< where the next observation should show the hand; null: anywhere
  std::shared_ptr<const HandProfile> profile;  ///< as fitted to the person so far
  Effort effort;                               ///< of the next search
  int full_attempts;                           ///< that a full search is worth; a quick one is worth one

  int attempts(Effort of_effort) const { return of_effort == Effort::full ? full_attempts : 1; }
};

/// Tracks one hand through a sequence of observations, in order. It follows the hand from frame to frame, proposes
/// other poses where that explains too little, chooses by one global score, keeps the track's state and learns the
/// person. Without a hand, or after a loss, it searches. Synchronous; owns no thread, clock, file or socket. Same
/// observations and seed, same estimates. Which parts decide something: docs/architecture.md.
class HandTracker {
 public:
  /// `workers` outlives it; `log` hears what compares samples with the data, what is learnt and what seems wrong.
  HandTracker(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, std::uint64_t seed,
              Workers& workers, std::shared_ptr<spdlog::logger> log = make_silent_logger(), HandIds ids = {});
  HandTracker(const HandTracker&) = delete;
  HandTracker& operator=(const HandTracker&) = delete;

  /// One frame. Never null; says searching or lost where there is no hand.
  HandEstimatePtr process(const HandObservation& observation);
  /// One frame of which somebody else decided whether it shows this hand: `found` by search(), or nothing.
  /// `decisions`: how that was decided.
  HandEstimatePtr process(const HandObservation& observation, std::optional<Hypothesis> found,
                          std::span<const Decision> decisions = {});
  /// The best pose that up to `attempts` searches find in the next observation, if that shows enough of a hand; fewer
  /// do where they settle it (RestartConsensus).
  std::optional<Hypothesis> search(const HandObservation& observation, Effort effort, int attempts);
  /// Before the next frame. UseParams may throw; then everything is as before.
  void apply(const TrackRequest& request);
  TrackView view() const;

 private:
  TrackEvidence begin_frame(const HandObservation& observation);
  void start_where_given(const HandObservation& observation, bool enough_data);
  void start_track();
  HandEstimatePtr conclude(const HandObservation& observation, const std::optional<Hypothesis>& best,
                           TrackEvidence evidence);
  TrackStatus update_state(const HandObservation& observation, const std::optional<Hypothesis>& best,
                           TrackEvidence& evidence);
  void commit(const HandObservation& observation, const Hypothesis& best);
  void start_anew();

  TrackerContext context_;
  PersonModel person_;
  Follower follower_;
  Choice choice_;
  Proposers proposers_;
  Track track_;
  EstimateBuilder estimates_;
  std::optional<HandPose> given_start_;
  std::uint32_t frame_ = 1;      // of the next observation: keys the random numbers
  std::int64_t last_utime_ = 0;  // [us]
};

}  // namespace barehand
