#pragma once

#include <vector>

#include "barehand/glove_state_t.hpp"
#include "barehand/hand_joints_t.hpp"
#include "barehand/hand_state_t.hpp"
#include "stages/publish/pose_hold.h"
#include "stages/publish/pose_smoother.h"

namespace barehand {

/// What is published of one frame.
struct HandMessages {
  hand_state_t state;
  glove_state_t glove;
  hand_joints_t joints;
};

/// The publish stage: estimates of one hand, in order, to messages. Equal estimates give equal bytes: nothing depends
/// on the clock. What is not known (no pose, unobservable) is NaN, never 0.
class HandMessageMaker {
 public:
  explicit HandMessageMaker(const PublishParams& params) : params_(params) {}
  /// An estimate with a pose must have a profile.
  HandMessages process(const HandEstimate& estimate);

 private:
  PublishParams params_;
  PoseHold hold_;
  PoseSmoother smoother_;
  std::shared_ptr<const HandProfile> profile_;  ///< the last one seen: a lost hand's estimate may come without
};

}  // namespace barehand
