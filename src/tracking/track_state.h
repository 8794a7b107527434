#pragma once

#include <optional>
#include <string_view>

#include "hand/hand_pose.h"

namespace barehand {

/// Thresholds of the track's state machine (TrackState). The global score is the mean mismatch of model and data [m].
struct LossParams {
  double lost_score = 0.005;
  double recovered_score = 0.004;
  double noise_factor = 1.0;
  int bad_frames = 4;
  int good_frames = 1;
  int min_hand_pixels = 200;  ///< a frame with fewer hand pixels counts as one without data
  double hold_time = 0.5;
  double forget_time = 3.0;
  bool operator==(const LossParams&) const = default;
};

template <class V>
void visit(V& v, LossParams& p) {
  // Declare the keys for the score of a frame.
  v.user("lost_score", p.lost_score, 1e-4, 0.1, "m, a frame with a higher global score is bad (for a hand of 190 mm)");
  v("recovered_score", p.recovered_score, 1e-4, 0.1,
    "m, a frame with a lower global score is good; between the two thresholds nothing changes");
  v("noise_factor", p.noise_factor, 0.0, 10.0,
    "standard deviations of the sensor noise that are added to both thresholds in quadrature");

  // Declare the keys for how long a state lasts.
  v("bad_frames", p.bad_frames, 1, 1000, "consecutive bad frames after which the hand is lost");
  v("good_frames", p.good_frames, 1, 1000,
    "consecutive good frames after which a hand that was searched for is tracked");
  v("min_hand_pixels", p.min_hand_pixels, 1, 1000000,
    "with fewer hand pixels the pose is held, and the search proposes no start pose");
  v.user("hold_time", p.hold_time, 0.0, 60.0, "s, how long the last pose is held without data before the hand is lost");
  v.user("forget_time", p.forget_time, 0.0, 3600.0,
         "s after the loss during which the last pose is one of the starts of the search");
}

/// The evidence of one frame about the tracked hand.
struct TrackEvidence {
  double dt = 0;                 ///< time since the previous frame [s]
  int hand_pixels = 0;           ///< number of pixels that may belong to this hand
  std::optional<double> score;   ///< global score of the best pose [m]; none: no pose was found or tried
  double noise = 0;              ///< HandObservation::noise [m]
  double hand_length = 0;        ///< HandProfile::hand_length() [m]
  bool to_be_confirmed = false;  ///< the score counts only if the next frame confirms the pose
};

/// The phases of a track: those of TrackStatus, and tentative, which is published as lost.
enum class TrackPhase { searching, tracking, holding, lost, tentative };
std::string_view to_string(TrackPhase phase);

/// The state machine of a track. It classifies every frame as one of five kinds and makes one transition:
///
///   from      | no data      | bad           | undecided | good          | to be confirmed
///   ----------|--------------|---------------|-----------|---------------|----------------
///   searching | searching    | searching     | searching | tracking (1)  | searching
///   tracking  | holding (3)  | tracking (2)  | tracking  | tracking      | tracking (2)
///   holding   | holding (3)  | holding (2)   | tracking  | tracking      | holding (2)
///   lost      | lost (4)     | lost (4)      | lost (4)  | tracking (1)  | tentative (4)
///   tentative | lost (4)     | lost (4)      | lost (4)  | tracking (1)  | tentative (4)
///
/// (1) after `good_frames` consecutive good frames, until then as if undecided; (2) lost after `bad_frames` bad frames;
/// (3) lost after `hold_time`; (4) searching after `forget_time`. While holding, the last pose is kept. While lost, the
/// last good pose is one of the starts of the search. Tentative means that a pose was found which the next frame must
/// confirm.
class TrackState {
 public:
  static constexpr double kReferenceHandLength = 0.19;  ///< hand length for which the thresholds are given [m]

  explicit TrackState(const LossParams& params) : params_(params) {}

  /// Continues with other thresholds.
  void change(const LossParams& params) { params_ = params; }
  /// Processes one frame and returns the new phase.
  TrackPhase update(const TrackEvidence& evidence);
  TrackPhase phase() const { return phase_; }
  /// The phase as it is published.
  TrackStatus status() const;
  /// Starts tracking from a pose that was given from outside; it ends as usual if the scores are bad.
  void start_tracking() { enter(TrackPhase::tracking); }
  void reset() { enter(TrackPhase::searching); }

  /// Global score [m] above which a frame with this noise and hand length is bad.
  double bad_threshold(const TrackEvidence& evidence) const;
  /// Global score [m] up to which a frame with this noise and hand length is good.
  double good_threshold(const TrackEvidence& evidence) const;

 private:
  enum class Kind { no_data, bad, undecided, good, to_be_confirmed };
  Kind kind_of(const TrackEvidence& evidence) const;
  TrackPhase next_while_tracked(Kind kind, double dt);
  TrackPhase next_while_lost(Kind kind, double dt);
  void enter(TrackPhase phase);

  LossParams params_;
  TrackPhase phase_ = TrackPhase::searching;
  // Numbers of consecutive good frames, and of bad ones with only undecided frames or frames without data in between.
  int good_ = 0, bad_ = 0;
  double time_in_phase_ = 0;  // time in the phase holding, or in lost and tentative together [s]
};

}  // namespace barehand
