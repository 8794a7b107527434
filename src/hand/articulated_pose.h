#pragma once

#include <array>

#include "hand/joint_angles.h"

namespace barehand {

/// A hand by its palm pose and joint angles: every joint closed, within limits.
struct ArticulatedPose {
  SE3 T_camera_palm;
  std::array<JointAngles, kSegmentCount> angles{};
};
HandPose posed(const HandProfile& profile, const ArticulatedPose& articulated);
/// Joint angles read off a pose, clamped to the limits.
ArticulatedPose articulated_from(const HandProfile& profile, const HandPose& pose,
                                 const std::array<JointLimits, kSegmentCount>& limits);
void clamp_angles(std::array<JointAngles, kSegmentCount>& angles, const std::array<JointLimits, kSegmentCount>& limits);

}  // namespace barehand
