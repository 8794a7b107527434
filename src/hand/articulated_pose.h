#pragma once

#include <array>

#include "hand/joint_angles.h"

namespace barehand {

/// A hand pose described by the pose of the palm and the joint angles, so that all joints are closed exactly.
struct ArticulatedPose {
  SE3 T_camera_palm;
  std::array<JointAngles, kSegmentCount> angles{};
};
/// The poses of all segments, by forward kinematics.
HandPose posed(const HandProfile& profile, const ArticulatedPose& articulated);
/// Converts segment poses to a palm pose and joint angles, which are clamped to `limits`.
ArticulatedPose articulated_from(const HandProfile& profile, const HandPose& pose,
                                 const std::array<JointLimits, kSegmentCount>& limits);
/// Clamps flexion and abduction to the limits and sets all twists to 0.
void clamp_angles(std::array<JointAngles, kSegmentCount>& angles, const std::array<JointLimits, kSegmentCount>& limits);

/// `pose` with one finger (0 the thumb) taken from the pose `other`, relative to the palm.
HandPose with_finger_of(const HandPose& pose, const HandPose& other, int finger);

}  // namespace barehand
