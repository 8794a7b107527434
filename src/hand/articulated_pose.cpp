// Converts between segment poses and joint angles.
#include "hand/articulated_pose.h"

#include <algorithm>

namespace barehand {

HandPose posed(const HandProfile& profile, const ArticulatedPose& articulated) {
  return forward_kinematics(profile, articulated.T_camera_palm, articulated.angles);
}

ArticulatedPose articulated_from(const HandProfile& profile, const HandPose& pose,
                                 const std::array<JointLimits, kSegmentCount>& limits) {
  ArticulatedPose result;
  result.T_camera_palm = pose[kPalm];
  for (int s = 1; s < kSegmentCount; ++s) result.angles[s] = joint_angles(profile, pose, s);
  clamp_angles(result.angles, limits);
  return result;
}

void clamp_angles(std::array<JointAngles, kSegmentCount>& angles,
                  const std::array<JointLimits, kSegmentCount>& limits) {
  for (int s = 1; s < kSegmentCount; ++s) {
    angles[s].flexion = std::clamp(angles[s].flexion, limits[s].flexion_lo, limits[s].flexion_hi);
    angles[s].abduction = std::clamp(angles[s].abduction, limits[s].abduction_lo, limits[s].abduction_hi);
    angles[s].twist = 0;
  }
}

HandPose with_finger_of(const HandPose& pose, const HandPose& other, int finger) {
  HandPose result = pose;
  const SE3 motion = pose[kPalm] * other[kPalm].inverse();
  for (int k = 0; k < 3; ++k) result[segment_of(finger, k)] = motion * other[segment_of(finger, k)];
  return result;
}

}  // namespace barehand
