#pragma once

#include <cstdint>
#include <optional>

#include "hand/contacts.h"
#include "hand/hand_pose.h"

namespace barehand {

/// The tracked hand whose palm is nearest to `place` (camera frame, m); null: no hand is tracked.
const HandEstimate* nearest_palm(const Eigen::Vector3d& place, const HandEstimates& estimates);

/// Says whether a hand holds an object: once the object has moved with a palm, until it leaves its place in the palm.
class Holding {
 public:
  /// Sets `held`, `hand_id` and `since` of the state from its pose and the hands of the frame. `centre`: middle of the
  /// object in its own frame [m], whose place in the palm is watched.
  void update(std::int64_t utime, const HandEstimates& estimates, const Eigen::Vector3d& centre, ObjectEstimate& state);
  /// T_camera_object if the object has moved with the palm that was nearest in the last frame; none: that hand is not
  /// tracked.
  std::optional<SE3> carried(const HandEstimates& estimates) const;

 private:
  std::int32_t hand_ = -1;  // hand_id of the nearest palm in the last frame; -1: none
  SE3 T_palm_object_;       // in that frame
  // Where the object was in that palm, and where the palm was, when the object came to its present place in it.
  Eigen::Vector3d in_palm_ = Eigen::Vector3d::Zero(), palm_ = Eigen::Vector3d::Zero();
  bool held_ = false;
  std::int64_t since_ = 0;
};

}  // namespace barehand
