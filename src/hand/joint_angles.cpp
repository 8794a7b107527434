// Joint angles, their limits, and forward kinematics.
#include "hand/joint_angles.h"

#include <algorithm>
#include <cmath>

namespace barehand {

JointAngles joint_angles(const Eigen::Matrix3d& R) {
  // R = Ry(a) Rz(t) Rx(-f) has the first column (cos a cos t, sin t, -sin a cos t) and the second row (sin t, cos t
  // cos f, cos t sin f).
  JointAngles angles;
  angles.twist = std::asin(std::clamp(R(1, 0), -1.0, 1.0));
  angles.abduction = std::atan2(-R(2, 0), R(0, 0));
  angles.flexion = std::atan2(R(1, 2), R(1, 1));
  return angles;
}

Eigen::Matrix3d joint_rotation(const JointAngles& angles) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return (AngleAxisd(angles.abduction, Vector3d::UnitY()) * AngleAxisd(angles.twist, Vector3d::UnitZ()) *
          AngleAxisd(-angles.flexion, Vector3d::UnitX()))
      .toRotationMatrix();
}

JointAngles joint_angles(const HandProfile& profile, const HandPose& pose, int segment) {
  if (segment == kPalm) return {};
  const Eigen::Matrix3d R_parent_rest = profile.rest_relative(segment).R;
  return joint_angles(R_parent_rest.transpose() * pose[parent_of(segment)].R.transpose() * pose[segment].R);
}

std::array<JointLimits, kSegmentCount> widened_limits(const HandProfile& profile, double widening) {
  std::array<JointLimits, kSegmentCount> limits{};
  for (int s = 0; s < kSegmentCount; ++s) {
    for (const JointDof& dof : profile.segments[s].dofs) {
      // A profile may count an angle about the opposite axis, which swaps and negates the range. Flexion is about -x,
      // abduction about +y.
      const bool flexion = std::abs(dof.axis.x()) > std::abs(dof.axis.y());
      const bool flipped = flexion ? dof.axis.x() > 0 : dof.axis.y() < 0;

      // Widen the range on both sides.
      const double lo = (flipped ? -dof.upper : dof.lower) - widening;
      const double hi = (flipped ? -dof.lower : dof.upper) + widening;
      (flexion ? limits[s].flexion_lo : limits[s].abduction_lo) = lo;
      (flexion ? limits[s].flexion_hi : limits[s].abduction_hi) = hi;
    }
  }
  return limits;
}

void place_segment(const HandProfile& profile, int segment, const JointAngles& angles, HandPose& pose) {
  pose[segment] = pose[parent_of(segment)] * profile.rest_relative(segment);
  pose[segment].R *= joint_rotation(angles);
}

HandPose forward_kinematics(const HandProfile& profile, const SE3& T_camera_palm,
                            const std::array<JointAngles, kSegmentCount>& angles) {
  HandPose pose;
  pose[kPalm] = T_camera_palm;
  for (int s = 1; s < kSegmentCount; ++s) place_segment(profile, s, angles[s], pose);
  return pose;
}

Eigen::Vector3d proximal_end(const HandPose& pose, int segment) { return pose[segment].t; }

Eigen::Vector3d distal_end(const HandProfile& profile, const HandPose& pose, int segment) {
  return pose[segment] * profile.segments[segment].distal;
}

Eigen::Vector3d joint_in_parent(const HandProfile& profile, const HandPose& pose, int segment) {
  return pose[parent_of(segment)] * profile.rest_relative(segment).t;
}

}  // namespace barehand
