#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "hand/joint_angles.h"
#include "support/adult_hand.h"

namespace barehand::test {

/// A tracked hand with these joint angles and no uncertainty.
inline HandEstimate grasping_hand(const std::array<JointAngles, kSegmentCount>& angles = {},
                                  Handedness side = Handedness::right, const SE3& palm = {}, double size = 1) {
  HandEstimate estimate;
  estimate.status = TrackStatus::tracking;
  estimate.hand_id = 1;
  estimate.utime = 1'000'000;
  estimate.handedness = side;
  estimate.profile = std::make_shared<const HandProfile>(scaled(*adult_hand(side), size));

  // Pose the segments, without uncertainty.
  const HandPose pose = forward_kinematics(*estimate.profile, palm, angles);
  for (int s = 0; s < kSegmentCount; ++s) {
    estimate.segments[s].T_camera_segment = pose[s];
    estimate.segments[s].covariance.setZero();
  }
  return estimate;
}

/// All fingers but the thumb bent by these angles [rad].
inline std::array<JointAngles, kSegmentCount> bent(double knuckle, double middle, double end) {
  std::array<JointAngles, kSegmentCount> angles;
  for (int finger = 1; finger < kFingerCount; ++finger) {
    angles[segment_of(finger, 0)].flexion = knuckle;
    angles[segment_of(finger, 1)].flexion = middle;
    angles[segment_of(finger, 2)].flexion = end;
  }
  return angles;
}

}  // namespace barehand::test
