#pragma once

#include <algorithm>
#include <optional>

#include "stages/pose_prior/hidden_fingers.h"
#include "stages/prediction/motion_prediction.h"
#include "stages/search/initialiser.h"
#include "tracking/baseline_score.h"
#include "tracking/hypotheses/hand_evidence.h"
#include "tracking/hypotheses/hypothesis.h"
#include "tracking/tracker_params.h"

namespace barehand {

/// What a tracker remembers of the hand that it follows or searches.
struct Track {
  explicit Track(const TrackerParams& params) : motion(params.prediction, params.icp), state(params.loss) {}

  MotionModel motion;
  TrackState state;
  HiddenFingers hidden_fingers;
  BaselineScore baseline;
  HandEvidence evidence;              ///< evidence, for each place, that a detection that is not tracked yet is a hand
  std::optional<HandPose> last_good;  ///< T_camera_segment of the last frame that was explained well
  int ambiguous_frames = 0;           ///< number of ambiguous frames since the track began
  int search_frames = 0;              ///< number of frames with a search since the hand was last followed well
  bool searched = false;              ///< whether the present frame was searched

  /// Whether a last pose of the hand is known, near which the hand most likely is.
  bool was_followed() const { return last_good || motion.has_pose(); }
  bool tentative() const { return state.phase() == TrackPhase::tentative; }

  /// Whether a score [m] is clearly worse than the baseline, and not confident either.
  bool is_ambiguous(double score, const ChoiceParams& choice) const {
    return score >= std::max(choice.confident_score, (1 + choice.ambiguity_margin) * baseline.level());
  }
  /// Whether a pose of a lost hand must be confirmed by the next frame, since a half-visible hand fits many poses
  /// roughly. `confirms`: the pose continues a tentative one, and so confirms it.
  bool needs_confirmation(double score, bool confirms, const ChoiceParams& choice) const {
    return choice.confirmation_factor > 0 && state.status() == TrackStatus::lost && !confirms &&
           score > choice.confirmation_factor * baseline.level();
  }
  /// Effort of the next search: one of `full_search_every` searches is full. Directly after a loss, the first searches
  /// are quick, since a full one would delay the next frames.
  Effort effort(int full_search_every) const {
    constexpr int kQuickFirst = 2;
    const int first_full = was_followed() ? std::min(kQuickFirst, full_search_every - 1) : 0;
    return search_frames % full_search_every == first_full ? Effort::full : Effort::quick;
  }

  /// Number of attempts of a search: one for a hand that was followed, since it is near its last pose, and up to
  /// `search_attempts` for the first start of a track.
  int attempts(Effort effort, int search_attempts) const {
    return effort == Effort::full && !was_followed() ? search_attempts : 1;
  }

  /// Continues the track with the pose of a frame; fingers that are not seen bend with their neighbours.
  void continue_with(const Hypothesis& best, const HandProfile& profile, const TrackerParams& params);
  /// Continues with other parameters; the state of the track stays as it is.
  void change(const TrackerParams& params);
  /// Forgets the hand, so that it is searched for without any prior knowledge.
  void forget();
};

}  // namespace barehand
