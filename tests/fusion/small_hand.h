#pragma once

#include "hand/joint_angles.h"
#include "math/angles.h"
#include "math/random.h"

namespace barehand {

/// A plausible right hand for tests: straight fingers side by side, saddle joints at the palm and hinges beyond.
inline HandProfile small_hand() {
  HandProfile profile;
  const auto shape = [](SegmentProfile& s, double length, double radius) {
    s.length = length;
    s.distal = {0, 0, -length};
    s.radius = s.half_width = s.half_thickness = {radius, radius};
  };
  shape(profile.segments[kPalm], 0.09, 0.02);
  profile.segments[kPalm].half_width = {0.04, 0.04};

  // The fingers, slightly fanned out.
  for (int finger = 0; finger < kFingerCount; ++finger)
    for (int k = 0; k < 3; ++k) {
      SegmentProfile& s = profile.segments[segment_of(finger, k)];
      shape(s, 0.03, 0.008);
      s.T_hand_segment.t = {-0.04 + 0.02 * finger, 0, -0.09 - 0.03 * k};
      s.T_hand_segment.R = exp_so3({0, 0.05 * (2 - finger), 0});

      // The joints.
      if (k == 0) s.dofs.push_back({"abduction", Eigen::Vector3d::UnitY(), -20 * kDegree, 20 * kDegree});
      s.dofs.push_back({"flexion", -Eigen::Vector3d::UnitX(), -10 * kDegree, 90 * kDegree});
    }
  return profile;
}

/// A random pose within +- `spread` [m] of a point half a metre in front of the camera, rotated by up to `angle` [rad]
/// about every axis.
inline SE3 random_pose(KeyedRandom& random, double spread, double angle) {
  const auto vector = [&](double r) {
    const double x = random.uniform(-r, r), y = random.uniform(-r, r), z = random.uniform(-r, r);
    return Eigen::Vector3d(x, y, z);
  };
  SE3 pose;
  pose.t = Eigen::Vector3d(0, 0, 0.5) + vector(spread);
  pose.R = exp_so3(vector(angle));
  return pose;
}

}  // namespace barehand
