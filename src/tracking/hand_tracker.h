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

// Requests to a tracker, which take effect before its next frame.

/// Start tracking at a given pose.
struct StartAt {
  HandPose pose;  ///< T_camera_segment; the next observation, if it shows a hand, is tracked from this pose
};
/// Forget the hand and the person, and search.
struct ResetTracker {};
/// Forget the hand, and search for that of another person.
struct UseProfile {
  std::shared_ptr<const HandProfile> profile;  ///< profile of the other person
};
/// Continue with the same hand, from its last pose and with the person learnt so far, but with other parameters.
struct UseParams {
  TrackerParams params;
};
/// The hand in view seems to have another size than its profile (PersonModel::note_size_mismatch).
struct NoteSizeMismatch {
  double size;  ///< size of the hand in view, as a factor on the profile's size
};
/// Let these known objects, which are near the hands, couple with the hand until the next such request, if
/// `refinement.objects.enabled` says so. Those that another hand holds are left out.
struct CoupleWith {
  std::span<const NearbyObject> objects;
};
using TrackRequest = std::variant<StartAt, ResetTracker, UseProfile, UseParams, NoteSizeMismatch, CoupleWith>;

/// The state of a track between two frames, for code outside the tracker.
struct TrackView {
  TrackStatus status;                          ///< status after the last observation
  bool tentative;                              ///< a lost hand may have been found; the next frame must confirm it
  bool size_mismatch;                          ///< the hand in view seems to have another size than its profile
  bool start_is_given;                         ///< a pose given by StartAt waits for the next observation
  const HandPose* expected_pose;               ///< last or given pose, near which the hand is expected; null: unknown
  std::shared_ptr<const HandProfile> profile;  ///< profile as it was fitted to the person so far
  std::shared_ptr<const Skin> skin;            ///< skin of that profile
  Effort effort;                               ///< effort of the next search
  int full_attempts;                           ///< number of attempts of a full search

  /// Number of attempts of a search with this effort; a quick search is tried once.
  int attempts(Effort of_effort) const { return of_effort == Effort::full ? full_attempts : 1; }
};

/// Tracks one hand through a sequence of observations, in order. It follows the hand from frame to frame, proposes
/// other poses if the followed one explains the frame badly, chooses by one global score, keeps the track's state and
/// learns the person's hand. Before the first hand and after a loss it searches. Synchronous; owns no thread, clock,
/// file or socket. The same observations and seed give the same estimates. docs/architecture.md lists the parts that
/// make decisions.
class HandTracker {
 public:
  /// `workers` must outlive the tracker. `log` receives whether the CPU or the GPU compares samples with the data, what
  /// is learnt of the person, and warnings. `skin`: of the profile; null: it is made.
  HandTracker(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, std::uint64_t seed,
              Workers& workers, std::shared_ptr<spdlog::logger> log = make_silent_logger(), HandIds ids = {},
              std::shared_ptr<const Skin> skin = nullptr);
  HandTracker(const HandTracker&) = delete;
  HandTracker& operator=(const HandTracker&) = delete;

  /// Processes one frame. The result is never null; its status says whether the hand is tracked.
  HandEstimatePtr process(const HandObservation& observation);
  /// Processes one frame for which the caller has decided whether it shows this hand: `found` is the result of
  /// search(), or none if it does not. `decisions`: how the caller decided.
  HandEstimatePtr process(const HandObservation& observation, std::optional<Hypothesis> found,
                          std::span<const Decision> decisions = {});
  /// Returns the best pose that up to `attempts` searches find in the next observation (Proposers::search_frame).
  std::optional<Hypothesis> search(const HandObservation& observation, Effort effort, int attempts);
  /// Executes a request between two frames. UseParams may throw; then nothing has changed.
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
  void reset_track();

  TrackerContext context_;
  PersonModel person_;
  Follower follower_;
  Choice choice_;
  Proposers proposers_;
  Track track_;
  EstimateBuilder estimates_;
  std::optional<HandPose> given_start_;
  std::uint32_t frame_ = 1;      // number of the next observation, which keys the random numbers
  std::int64_t last_utime_ = 0;  // time stamp of the last observation [us]; 0: none yet
};

}  // namespace barehand
