#pragma once

#include "hand/grasps/frame_grasps.h"

namespace barehand {

/// The grasp of one hand over time: probabilities averaged over the last moments in the log domain, and a class that
/// changes with hysteresis. Successive poses of a tracker err alike, so that frames are averaged, not multiplied as
/// independent evidence: a grasp that lasts does not become more certain than its single frames.
class GraspFilter {
 public:
  /// `memory`: time constant of the average [s].
  explicit GraspFilter(double memory) : memory_(memory) {}

  /// Forgets everything: the next frame counts alone, and the class is none until another is clearly more probable.
  void reset();
  /// Adds the probabilities of a frame, `seconds` after the last one.
  const GraspProbabilities& add(const std::array<double, kGraspCount>& log_probabilities, double seconds);
  /// The stated class: a grasp as soon as all grasps together are more probable than none, until none is clearly more
  /// probable. It changes to a class that is clearly more probable.
  int grasp() const { return grasp_; }

 private:
  double memory_;
  bool empty_ = true;
  std::array<double, kGraspCount> mean_{};  // mean of the logarithms
  GraspProbabilities probabilities_{};
  int grasp_ = 0;
};

}  // namespace barehand
