#pragma once

#include <optional>
#include <string_view>

#include "hand/hand_pose.h"

namespace barehand {

/// When a hand counts as tracked. The global score is the mean mismatch of model and data [m].
struct LossParams {
  double lost_score = 0.005;
  double recovered_score = 0.004;
  double noise_factor = 1.0;
  int bad_frames = 4;
  int good_frames = 1;
  int min_hand_pixels = 200;  ///< fewer are no data: the pose is held
  double hold_time = 0.5;
  double forget_time = 3.0;
  bool operator==(const LossParams&) const = default;
};

template <class V>
void visit(V& v, LossParams& p) {
  v.user("lost_score", p.lost_score, 1e-4, 0.1, "m, a frame with a higher global score is bad (for a hand of 190 mm)");
  v("recovered_score", p.recovered_score, 1e-4, 0.1,
    "m, a frame with a lower global score is good; between the two thresholds nothing changes");
  v("noise_factor", p.noise_factor, 0.0, 10.0,
    "standard deviations of the sensor noise that are added to both thresholds in quadrature");
  v("bad_frames", p.bad_frames, 1, 1000, "consecutive bad frames after which the hand is lost");
  v("good_frames", p.good_frames, 1, 1000,
    "consecutive good frames after which a hand that was searched for is tracked");
  v("min_hand_pixels", p.min_hand_pixels, 1, 1000000,
    "with fewer hand pixels the pose is held, and the search proposes no start pose");
  v.user("hold_time", p.hold_time, 0.0, 60.0, "s, how long the last pose is held without data before the hand is lost");
  v.user("forget_time", p.forget_time, 0.0, 3600.0,
         "s after the loss during which the last pose is one of the starts of the search");
}

/// What one frame says about the tracked hand.
struct TrackEvidence {
  double dt = 0;                 ///< since the frame before [s]
  int hand_pixels = 0;           ///< that may be this hand; 0 where none are
  std::optional<double> score;   ///< global score of the best pose [m]; none: no pose was found or tried
  double noise = 0;              ///< HandObservation::noise [m]
  double hand_length = 0;        ///< HandProfile::hand_length() [m]
  bool to_be_confirmed = false;  ///< the score counts only if the next frame confirms the pose
};

/// Where a track stands: a TrackStatus, or tentative, which is published as lost.
enum class TrackPhase { searching, tracking, holding, lost, tentative };
std::string_view to_string(TrackPhase phase);

/// The state machine of a track. It sorts every frame into one of five kinds and takes one transition:
///
///   from      | no data      | bad           | undecided | good          | to be confirmed
///   ----------|--------------|---------------|-----------|---------------|----------------
///   searching | searching    | searching     | searching | tracking (1)  | searching
///   tracking  | holding (3)  | tracking (2)  | tracking  | tracking      | tracking (2)
///   holding   | holding (3)  | holding (2)   | tracking  | tracking      | holding (2)
///   lost      | lost (4)     | lost (4)      | lost (4)  | tracking (1)  | tentative (4)
///   tentative | lost (4)     | lost (4)      | lost (4)  | tracking (1)  | tentative (4)
///
/// (1) after `good_frames` good ones in a row, until then as if undecided; (2) lost after `bad_frames` bad ones;
/// (3) lost after `hold_time`; (4) searching after `forget_time`. While holding, the pose is kept. While lost, the
/// last good pose is one of the starts of the search. While tentative, a pose was found that the next frame must
/// confirm.
class TrackState {
 public:
  static constexpr double kReferenceHandLength = 0.19;  ///< [m]

  explicit TrackState(const LossParams& params) : params_(params) {}

  /// The phase after this frame.
  TrackPhase update(const TrackEvidence& evidence);
  TrackPhase phase() const { return phase_; }
  /// The phase as it is published.
  TrackStatus status() const;
  /// A pose was given from outside: tracking until the scores say otherwise.
  void start_tracking() { enter(TrackPhase::tracking); }
  void reset() { enter(TrackPhase::searching); }

  /// Score [m] above which a frame with this noise and hand is bad; below `good_threshold` it is good.
  double bad_threshold(const TrackEvidence& evidence) const;
  double good_threshold(const TrackEvidence& evidence) const;

 private:
  enum class Kind { no_data, bad, undecided, good, to_be_confirmed };
  Kind kind_of(const TrackEvidence& evidence) const;
  TrackPhase next_while_tracked(Kind kind, double dt);
  TrackPhase next_while_lost(Kind kind, double dt);
  void enter(TrackPhase phase);

  LossParams params_;
  TrackPhase phase_ = TrackPhase::searching;
  int good_ = 0, bad_ = 0;    // consecutive frames
  double time_in_phase_ = 0;  // [s] holding, or lost and tentative together
};

}  // namespace barehand
