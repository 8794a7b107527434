#pragma once

#include <optional>
#include <vector>

#include "stages/grasp/grasp_classifier.h"
#include "stages/grasp/grasp_filter.h"

namespace barehand {

/// The grasp stage: says how the tracked hands of a frame grasp, from their poses and covariances and what they touch,
/// frame after frame in order. It changes no estimate. Nothing is stated of a hand that is not tracked.
class GraspStage {
 public:
  explicit GraspStage(GraspClassifier classifier) : classifier_(std::move(classifier)) {}
  /// `contacts` null: contacts were not looked for.
  Result<FrameGraspsPtr> process(const HandEstimates& estimates, const FrameContactsPtr& contacts);

 private:
  /// One hand over time.
  struct Hand {
    explicit Hand(double memory) : filter(memory) {}
    GraspFilter filter;
    std::int32_t id = -1;
    std::int64_t utime = 0;  // time of the last frame in which the hand was tracked
    std::optional<std::int64_t> since;
    int grasp = 0;
  };

  HandGrasp estimate_grasp(Hand& hand, const HandEstimate& estimate, const SegmentContacts* objects) const;

  GraspClassifier classifier_;
  std::vector<Hand> hands_;  // in the order of the estimates
};

}  // namespace barehand
