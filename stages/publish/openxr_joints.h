#pragma once

#include <array>

#include "hand/hand_pose.h"

namespace barehand {

/// XrHandJointEXT: palm, wrist, thumb {metacarpal, proximal, distal, tip}, then index, middle, ring, little
/// {metacarpal, proximal, intermediate, distal, tip}.
inline constexpr int kOpenXrJointCount = 26;

struct OpenXrJoint {
  SE3 T_camera_joint;   ///< -z along the bone, +y dorsal
  double radius = 0;    ///< joint centre to skin [m]
  int segment = kPalm;  ///< what it moves with
};

/// Segments are joints of OpenXR already; added are the palm's centre, the fingertips and, fixed in the palm, the
/// metacarpals of the four fingers: on the line from the wrist to the knuckle, with anatomical lengths (Buryanov &
/// Kotiuk 2010) scaled to this hand.
std::array<OpenXrJoint, kOpenXrJointCount> openxr_joints(const HandProfile& profile, const HandPose& pose);

}  // namespace barehand
