#include "drivers/synthetic/hand/skeleton.h"

#include "math/angles.h"

namespace barehand::synthetic {

// Forward kinematics of the simulated hand, and its named shapes such as the fist.

namespace {

FingerAngles degrees(double abduction, double first, double second, double third) {
  return {abduction * kDegree, {first * kDegree, second * kDegree, third * kDegree}};
}

}  // namespace

HandPose pose_segments(const HandProfile& profile, const SkeletonPose& skeleton) {
  std::array<JointAngles, kSegmentCount> joints{};
  for (int finger = 0; finger < kFingerCount; ++finger)
    for (int k = 0; k < 3; ++k) joints[segment_of(finger, k)].flexion = skeleton.angles[finger].flexion[k];
  for (int finger = 0; finger < kFingerCount; ++finger) {
    const int s = segment_of(finger, 0);
    const Eigen::Vector3d axis = profile.segments[s].dofs.front().axis;  // abduction is the first of the dofs
    joints[s].abduction = axis.y() * skeleton.angles[finger].abduction;
  }
  return forward_kinematics(profile, skeleton.T_camera_palm, joints);
}

HandAngles open_joined() {
  return {degrees(0, 0, 5, 5), degrees(-2, 3, 4, 3), degrees(0, 2, 4, 3), degrees(-7, 3, 4, 3), degrees(-9, 4, 4, 3)};
}

HandAngles open_spread() {
  return {degrees(0, -18, 0, 0), degrees(13, 0, 4, 3), degrees(1, 0, 4, 3), degrees(5, 0, 4, 3), degrees(13, 2, 4, 3)};
}

HandAngles open_relaxed() {
  return {degrees(6, 0, 10, 12), degrees(3, 12, 16, 9), degrees(0, 14, 18, 10), degrees(-2, 16, 20, 11),
          degrees(1, 18, 20, 11)};
}

HandAngles fist() {
  return {degrees(0, 4, 20, 20), degrees(-3, 72, 92, 48), degrees(0, 76, 94, 48), degrees(-5, 78, 94, 48),
          degrees(-6, 80, 90, 46)};
}

}  // namespace barehand::synthetic
