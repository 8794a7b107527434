#pragma once

#include <array>

#include "hand/hand_pose.h"

namespace barehand {

/// The number of joints of XrHandJointEXT: palm, wrist, thumb {metacarpal, proximal, distal, tip}, then index, middle,
/// ring and little finger {metacarpal, proximal, intermediate, distal, tip}.
inline constexpr int kOpenXrJointCount = 26;

struct OpenXrJoint {
  SE3 T_camera_joint;   ///< -z along the bone, +y dorsal
  double radius = 0;    ///< distance from the joint's centre to the skin [m]
  int segment = kPalm;  ///< the segment that it moves with
};

/// The OpenXR joints of a pose. The origin of every segment is one of them. The palm's centre, the fingertips and the
/// metacarpals of the four fingers are added. The metacarpals are fixed in the palm, on the lines from the wrist to the
/// knuckles, with anatomical lengths (Buryanov & Kotiuk 2010) scaled to this hand.
std::array<OpenXrJoint, kOpenXrJointCount> openxr_joints(const HandProfile& profile, const HandPose& pose);

}  // namespace barehand
