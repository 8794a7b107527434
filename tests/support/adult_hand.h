#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "hand/joint_angles.h"
#include "io/hand/hand_json.h"

namespace barehand::test {

/// The shipped adult hand; a left hand is its mirror image.
inline std::shared_ptr<const HandProfile> adult_hand(Handedness side = Handedness::right) {
  const Result<HandProfile> right = load_profile(BAREHAND_CONFIGS "/hands/adult_right.json");
  EXPECT_TRUE(right) << right.error().message();
  return std::make_shared<const HandProfile>(side == Handedness::right ? *right : mirrored(*right));
}

/// A pose with the fingers up and the palm towards a camera at `distance` [m]. Every joint of the fingers, except the
/// thumb's, is flexed by `flexion` [rad].
inline HandPose facing_pose(const HandProfile& profile, double distance, double flexion = 0.15) {
  SE3 T_camera_palm;
  // Hand -z (fingers) is camera -y (up), and hand +y (back of the hand) is camera +z (away from the camera).
  T_camera_palm.R << 1, 0, 0, 0, 0, 1, 0, 1, 0;
  if (T_camera_palm.R.determinant() < 0) T_camera_palm.R.col(0) *= -1;
  T_camera_palm.t = {0, 0.08, distance};
  std::array<JointAngles, kSegmentCount> angles{};
  for (int s = 1; s < kSegmentCount; ++s)
    if (finger_of(s) > 0) angles[s].flexion = flexion;
  return forward_kinematics(profile, T_camera_palm, angles);
}

/// The pose turned about the point `centre` [m] by a rotation vector [rad], both in the camera frame.
inline HandPose turned(HandPose pose, const Eigen::Vector3d& rotation, const Eigen::Vector3d& centre) {
  const Eigen::Matrix3d R = exp_so3(rotation);
  for (SE3& T : pose) T = {R * T.R, centre + R * (T.t - centre)};
  return pose;
}

}  // namespace barehand::test
