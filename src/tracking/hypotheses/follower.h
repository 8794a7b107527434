#pragma once

#include <vector>

#include "tracking/hand_model.h"
#include "tracking/hypotheses/choice.h"
#include "tracking/hypotheses/hypothesis.h"
#include "tracking/hypotheses/sample_budget.h"
#include "tracking/tracker_context.h"

namespace barehand {

/// Follows a hand from the last frame into the present one by the paper's method: prediction (Sec. 4.4), then local
/// trackers and belief propagation level by level (Sec. 4.1 to 4.3). In addition, and in parallel, it refines the
/// predicted poses.
class Follower {
 public:
  /// `context` must outlive the object.
  explicit Follower(const TrackerContext& context);

  /// Returns the better one of the refined and the sampled pose. motion.has_pose() must be true. `frame`, the number of
  /// the frame, keys the random numbers.
  Hypothesis follow(const HandObservation& observation, HandModel& hand, MotionModel& motion, std::uint32_t frame,
                    Choice& choice);
  /// Adopts changed parameters of the context; must be called after every change.
  void change();

 private:
  FusedPose sample(const HandObservation& observation, HandModel& hand, const Prediction& prediction,
                   std::uint32_t frame);
  void measure_budget(const PreparedObservation& prepared, HandModel& hand, const HandPose& predicted,
                      std::uint32_t frame);
  RefinedPose refine_best_start(const HandObservation& observation, const HandModel& hand,
                                const Prediction& prediction);
  bool is_distinct(const HandProfile& profile, const RefinedPose& refined, const HandPose& sampled) const;
  double interval_factor(double dt) const;

  const TrackerContext& context_;
  SampleBudget budget_;
  std::vector<HandPose> starts_;  // scratch: start poses of the refinement
};

}  // namespace barehand
