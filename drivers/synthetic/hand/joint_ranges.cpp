#include "drivers/synthetic/hand/joint_ranges.h"

#include "math/angles.h"

namespace barehand::synthetic {

// The axes and ranges of the simulated hand's joints.

namespace {

constexpr std::array<const char*, kFingerCount> kFingers = {"thumb", "index", "middle", "ring", "little"};

struct Range {
  double lower, upper;  // limits of the angle [degrees]
};

JointDof dof(int finger, const char* joint, const Eigen::Vector3d& axis, Range range) {
  return {std::string(kFingers[finger]) + joint, axis, range.lower * kDegree, range.upper * kDegree};
}

std::vector<JointDof> thumb_dofs(int k, const Eigen::Vector3d& abduction, const Eigen::Vector3d& flexion) {
  if (k == 0) return {dof(0, "_cmc_abd", abduction, {-25, 35}), dof(0, "_cmc_flex", flexion, {-20, 35})};
  if (k == 1) return {dof(0, "_mcp_abd", abduction, {-8, 8}), dof(0, "_mcp_flex", flexion, {-10, 55})};
  return {dof(0, "_ip_flex", flexion, {-10, 80})};
}

}  // namespace

std::vector<JointDof> joint_dofs(int segment, Handedness handedness) {
  if (segment == kPalm) return {};
  const int finger = finger_of(segment), k = (segment - 1) % 3;
  // A rotation about +y moves a right hand's finger towards the thumb, a left hand's towards the little finger.
  const double side = side_sign(handedness) * (finger <= 2 ? 1 : -1);
  const Eigen::Vector3d abduction = side * Eigen::Vector3d::UnitY(), flexion = -Eigen::Vector3d::UnitX();
  if (finger == 0) return thumb_dofs(k, abduction, flexion);
  if (k == 0) return {dof(finger, "_mcp_abd", abduction, {-18, 18}), dof(finger, "_mcp_flex", flexion, {-20, 90})};
  if (k == 1) return {dof(finger, "_pip_flex", flexion, {0, 105})};
  return {dof(finger, "_dip_flex", flexion, {-5, 75})};
}

}  // namespace barehand::synthetic
