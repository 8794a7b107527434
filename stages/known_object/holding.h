#pragma once

#include <cstdint>

#include "hand/contacts.h"
#include "hand/hand_pose.h"

namespace barehand {

/// Says whether a hand holds an object: once the object has moved with a palm, until it leaves its place in the palm.
class Holding {
 public:
  /// Sets `held`, `hand_id` and `since` of the state from its pose and the hands of the frame.
  void update(std::int64_t utime, const HandEstimates& estimates, ObjectEstimate& state);

 private:
  Eigen::Vector3d in_palm_, palm_;   // place in the palm, and place of the palm, when both were first compared
  std::int32_t compared_hand_ = -1;  // hand_id of that palm; -1: none
  bool held_ = false;
  std::int64_t since_ = 0;
};

}  // namespace barehand
