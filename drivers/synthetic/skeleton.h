#pragma once

#include <array>

#include "hand/joint_angles.h"

namespace barehand::synthetic {

/// The 20 joint angles of the animated hand [rad], per finger. Flexion counts towards the palm, abduction away from the
/// middle finger (the middle finger's own: towards the index; the thumb's: out of the palm's plane).
struct FingerAngles {
  double abduction = 0;             ///< knuckle; the thumb's CMC joint
  std::array<double, 3> flexion{};  ///< from the palm to the tip (thumb: CMC, MCP, IP; fingers: MCP, PIP, DIP)
};
using HandAngles = std::array<FingerAngles, kFingerCount>;

/// 26 degrees of freedom: the wrist's six and the joint angles.
struct SkeletonPose {
  SE3 T_camera_palm;
  HandAngles angles;
};

/// All segments of an animated hand; every joint closed.
HandPose pose_segments(const HandProfile& profile, const SkeletonPose& skeleton);

/// Named shapes of the hand.
HandAngles open_joined();
HandAngles open_spread();
HandAngles open_relaxed();
HandAngles fist();

}  // namespace barehand::synthetic
