#pragma once

#include <array>

#include "hand/joint_angles.h"

namespace barehand::synthetic {

/// Joint angles of one finger of the animated hand [rad]; a hand has 20. Flexion is positive towards the palm;
/// abduction is positive away from the middle finger (for the middle finger: towards the index; for the thumb: out of
/// the palm's plane).
struct FingerAngles {
  double abduction = 0;             ///< abduction of the knuckle (MCP joint); for the thumb, of the CMC joint
  std::array<double, 3> flexion{};  ///< flexion from palm to tip (thumb: CMC, MCP, IP; fingers: MCP, PIP, DIP)
};
using HandAngles = std::array<FingerAngles, kFingerCount>;

/// The 26 degrees of freedom of the animated hand: six of the wrist, and the joint angles.
struct SkeletonPose {
  SE3 T_camera_palm;
  HandAngles angles;
};

/// The poses of all segments of an animated hand, with closed joints.
HandPose pose_segments(const HandProfile& profile, const SkeletonPose& skeleton);

/// Named shapes of the hand.
HandAngles open_joined();
HandAngles open_spread();
HandAngles open_relaxed();
HandAngles fist();

}  // namespace barehand::synthetic
