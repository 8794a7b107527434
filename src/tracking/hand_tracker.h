#pragma once

#include <memory>
#include <optional>

#include "core/log.h"
#include "hand/hand_pose.h"
#include "observe/observation.h"
#include "person/person_fit.h"
#include "person/person_scan.h"
#include "stages/refinement/pose_uncertainty.h"
#include "tracking/hand_model.h"
#include "tracking/sample_budget.h"
#include "tracking/size_check.h"
#include "tracking/usual_score.h"

namespace barehand {

/// The ids that a tracker gives to the hands it finds, one after the other.
struct HandIds {
  std::int32_t first = 1, step = 1;
};

/// Tracks one hand through a sequence of observations, in order: prediction, then segment tracker and fusion level by
/// level, then refinement and the choice of the best hypothesis by one global score. Without a hand, or after a loss,
/// it searches. Synchronous; owns no thread, clock, file or socket. Same observations and seed, same estimates.
class HandTracker {
 public:
  /// What one frame yielded before it is judged.
  struct Fit {
    RefinedPose refined;
    double joint_gap = 0;
    double size = 1;  ///< of the hand in view relative to the profile, where the search showed another one
    std::optional<Prediction> prediction;                       ///< none: found by a search
    std::optional<std::array<Matrix6d, kSegmentCount>> belief;  ///< covariance by the sampler alone, without refinement
  };

  /// `workers` outlives it; `log` hears what compares samples with the data, and when that is lost.
  HandTracker(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, std::uint64_t seed,
              Workers& workers, std::shared_ptr<spdlog::logger> log = make_silent_logger(), HandIds ids = {});

  /// Never null; says searching or lost where there is no hand.
  HandEstimatePtr process(const HandObservation& observation);
  /// The same where somebody else decides whether it is this hand: `found` by look(), or nothing.
  HandEstimatePtr process(const HandObservation& observation, std::optional<Fit> found);
  /// The best pose that up to `attempts` searches find in the next observation, if that shows this hand; fewer do if
  /// they settle it (FoundPoses).
  std::optional<Fit> look(const HandObservation& observation, Effort effort, int attempts);
  /// Of the next search: most are quick ones.
  Effort effort() const;
  /// What a search with this effort is worth: a hand that was tracked before is near its last pose, a first start is
  /// worth several.
  int attempts(Effort effort) const { return effort == Effort::full && !was_followed() ? params_.search_attempts : 1; }
  /// As of the last observation.
  TrackStatus status() const { return loss_.status(); }
  /// As fitted to the person so far.
  const HandProfile& profile() const { return *model_->profile; }
  bool start_is_given() const { return requested_start_.has_value(); }
  /// Where the next observation should show the hand (T_camera_segment); null: anywhere.
  const HandPose* whereabouts() const {
    return requested_start_ ? &*requested_start_ : (motion_.has_pose() ? &motion_.pose() : nullptr);
  }
  /// A lost hand may have been found in the last observation; it is tracked if following it explains the next one, too.
  bool unconfirmed() const { return unconfirmed_; }
  /// The next observation, if it shows a hand, is tracked from this pose (T_camera_segment).
  void start_at(const HandPose& pose) { requested_start_ = pose; }
  /// The hand in view has `size` times the profile's size: said once, and no pose is certain from now on.
  void doubt_size(double size);
  bool doubts_size() const { return size_in_view_ != 1; }
  /// Goes on with other parameters: the same hand from its last pose, as fitted to the person so far. What fits it
  /// stays as it is (`shape_fit`).
  void change(const TrackerParams& params);
  /// Forgets the hand and the person; the next observation is searched.
  void reset();
  /// For a tracker that takes this one's place: no id is given twice.
  HandIds further_ids() const { return {hand_id_ ? hand_id_ + ids_.step : ids_.first, ids_.step}; }

 private:
  void begin_at(const HandPose& pose, std::int64_t utime);
  /// The best pose for this frame: followed from the last one, or found anew where that explains too little.
  std::optional<Fit> explain(const HandObservation& observation, double bad_score);
  bool was_followed() const { return last_good_ || motion_.has_pose(); }
  bool doubtful(double score);
  bool unlike_before(double score) const;
  bool needs_confirmation(const Fit& found, double score) const;
  /// By `factor`, and not convincing.
  bool worse_than_usual(double score, double factor) const;
  bool lies_elsewhere(const RefinedPose& refined, const HandPose& sampled) const;
  std::optional<Fit> follow(const HandObservation& observation);
  std::optional<Fit> search_once(const HandObservation& observation, Effort effort, int attempt);
  void uncross(const HandObservation& observation, Fit& fit);
  std::optional<Fit> search_doubtful(const HandObservation& observation, const HandPose& followed);
  double judged_score(const HandObservation& observation, const RefinedPose& refined) const;
  std::optional<Fit> propose_detected(const HandObservation& observation) const;
  std::optional<Fit> search_near(const HandObservation& observation, const HandPose& followed);
  std::optional<Fit> best_of(const HandObservation& observation, const std::vector<StartCandidate>& starts,
                             int iterations) const;
  TrackEvidence evidence(const HandObservation& observation);
  HandEstimatePtr judge(const HandObservation& observation, const std::optional<Fit>& fit, TrackEvidence evidence);
  void greet_new_hand();
  FusedPose sample(const HandObservation& observation, const Prediction& prediction);
  void measure_budget(const PreparedObservation& prepared, const HandPose& predicted);
  RefinedPose refine_best_start(const HandObservation& observation, const Prediction& prediction);
  void remember(const HandObservation& observation, const Fit& fit);
  void check_size(const HandObservation& observation, const RefinedPose& refined);
  void forget_person();
  void meet_person();
  void learn_person(const HandObservation& observation, const HandPose& pose);
  void use_scan();
  HandEstimatePtr estimate(const HandObservation& observation, const std::optional<Fit>& fit);
  void fill_segments(HandEstimate& out, const Fit& fit);
  Matrix6d scale_doubt(const SE3& T_camera_segment) const;
  void fill_held(HandEstimate& out) const;
  double interval_factor(double dt) const;
  double raw_gap(const HandPose& pose) const;

  TrackerParams params_;
  std::uint64_t seed_;
  Workers& workers_;
  std::shared_ptr<spdlog::logger> log_;
  std::shared_ptr<const HandProfile> given_;  // before anything is learnt of the person
  std::shared_ptr<Observer> observer_;        // lasts while models change: it may be a GPU
  SampleBudget budget_;
  std::unique_ptr<HandModel> model_;
  std::optional<PersonFit> person_;      // if the given hand is a mean hand
  std::unique_ptr<PersonScan> scan_;     // if its skin was not scanned before
  std::optional<SizeCheck> size_check_;  // of a hand that is not fitted, or no longer
  double size_in_view_ = 1;              ///< of the hand by that of its profile, as far as that is known
  bool said_size_ = false;
  MotionModel motion_;
  LossDetector loss_;
  PoseUncertainty uncertainty_;

  std::uint32_t frame_ = 1;  // of the next observation: keys the random numbers
  bool searched_ = false;    // for the hand in this frame
  int search_frames_ = 0;    // in which it was, since the last hand
  int doubtful_frames_ = 0;
  UsualScore usual_score_;
  std::int64_t last_utime_ = 0;
  const HandIds ids_;
  std::int32_t hand_id_ = 0;
  std::optional<HandPose> requested_start_, last_good_;
  bool unconfirmed_ = false;
  std::vector<HandPose> starts_;  // scratch: where the refinement of a frame may begin
  HandEstimatePtr last_tracked_;  // base of velocities and of holding
};

}  // namespace barehand
