#pragma once

#include <algorithm>
#include <optional>

#include "stages/prediction/motion_prediction.h"
#include "stages/search/initialiser.h"
#include "tracking/baseline_score.h"
#include "tracking/hypotheses/hand_evidence.h"
#include "tracking/hypotheses/hypothesis.h"
#include "tracking/tracker_params.h"

namespace barehand {

/// What a tracker remembers of the hand that it follows or looks for.
struct Track {
  explicit Track(const TrackerParams& params) : motion(params.prediction, params.icp), state(params.loss) {}

  MotionModel motion;
  TrackState state;
  BaselineScore baseline;
  HandEvidence evidence;              ///< that what is detected, and was not followed yet, is a hand
  std::optional<HandPose> last_good;  ///< T_camera_segment of the last frame that was explained well
  int ambiguous_frames = 0;           ///< since the track began
  int search_frames = 0;              ///< in which it was searched, since it was followed last
  bool searched = false;              ///< whether it was in this frame

  /// Whether a hand was followed until now, so that it is most likely near its last pose.
  bool was_followed() const { return last_good || motion.has_pose(); }
  bool tentative() const { return state.phase() == TrackPhase::tentative; }

  /// Whether a frame is explained worse than `factor` times the baseline, and not confidently either.
  bool worse_than_usual(double score, double factor, const ChoiceParams& choice) const {
    return score >= std::max(choice.search_convincing, factor * baseline.level());
  }
  /// A hand that was lost a moment ago is known: what is explained so much worse is half of it, or something else.
  bool unlike_before(double score, const ChoiceParams& choice) const {
    return choice.unlike > 0 && state.status() == TrackStatus::lost && worse_than_usual(score, choice.unlike, choice);
  }
  /// Whether a pose of a lost hand needs the next frame's confirmation: half of a hand fits many poses a little.
  /// `confirms`: it continues a tentative pose, and so confirms it.
  bool needs_confirmation(double score, bool confirms, const ChoiceParams& choice) const {
    return choice.unsure > 0 && state.status() == TrackStatus::lost && !confirms &&
           score > choice.unsure * baseline.level() && !unlike_before(score, choice);
  }
  /// Effort of the next search. Most are quick. After a track they are at first, too, as a full one would hold up its
  /// next frames.
  Effort effort(int full_search_every) const {
    constexpr int kQuickFirst = 2;
    const int first_full = was_followed() ? std::min(kQuickFirst, full_search_every - 1) : 0;
    return search_frames % full_search_every == first_full ? Effort::full : Effort::quick;
  }

  /// What a search is worth: a hand that was followed is near its last pose, a first start is worth several full ones.
  int attempts(Effort effort, int search_attempts) const {
    return effort == Effort::full && !was_followed() ? search_attempts : 1;
  }

  /// The pose of a frame that continues the track; fingers that are not seen follow their neighbours.
  void continue_with(const Hypothesis& best, const HandProfile& profile, const TrackerParams& params);
  /// Continues with other parameters: a hand that was followed is followed on.
  void change(const TrackerParams& params);
  /// No hand is known any more.
  void forget();
};

}  // namespace barehand
