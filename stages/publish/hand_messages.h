#pragma once

#include <optional>

#include "barehand/contact_state_t.hpp"
#include "barehand/glove_state_t.hpp"
#include "barehand/grasp_state_t.hpp"
#include "barehand/hand_joints_t.hpp"
#include "barehand/hand_state_t.hpp"
#include "stages/publish/pose_hold.h"
#include "stages/publish/pose_smoother.h"

namespace barehand {

// The publish stage: converts estimates to LCM messages.

/// The messages about one hand in one frame.
struct HandMessages {
  hand_state_t state;
  glove_state_t glove;
  hand_joints_t joints;
  std::optional<contact_state_t> contact = {};  ///< none: contacts are switched off
  std::optional<grasp_state_t> grasp = {};      ///< none: grasps are switched off
};

/// The publish stage: converts the estimates of one hand, in order, to messages. Equal estimates give equal bytes,
/// since nothing depends on the clock. A value that is not known (no pose, unobservable) is NaN, never 0.
class HandMessageMaker {
 public:
  explicit HandMessageMaker(const PublishParams& params) : params_(params) {}
  /// Makes the messages of one frame. An estimate with a pose must have a profile.
  HandMessages process(const HandEstimate& estimate);

 private:
  PublishParams params_;
  PoseHold hold_;
  PoseSmoother smoother_;
  std::int32_t hand_id_ = 0;                    // of the last estimate
  std::shared_ptr<const HandProfile> profile_;  ///< last known profile, since the estimate of a lost hand may have none
};

}  // namespace barehand
