// The derivatives of a joint's gap and angles with respect to the poses of its two segments.
#include "hand/joint_linearisation.h"

#include <algorithm>
#include <cmath>

#include "math/se3.h"

namespace barehand {

JointLinearisation linearise_joint(const HandProfile& profile, const HandPose& pose, int segment) {
  return linearise_joint(profile.rest_relative(segment), pose, segment);
}

JointLinearisation linearise_joint(const SE3& rest, const HandPose& pose, int segment) {
  const SE3& parent = pose[parent_of(segment)];

  // Compute the joint's position and orientation as given by the parent's pose.
  JointLinearisation joint;
  joint.lever = parent.R * rest.t;
  joint.gap = parent.t + joint.lever - pose[segment].t;
  joint.R_camera_joint = parent.R * rest.R;
  joint.R_joint_segment = joint.R_camera_joint.transpose() * pose[segment].R;
  joint.angles = joint_angles(joint.R_joint_segment);

  // R = Ry(a) Rz(t) Rx(-f) has the angular velocity e_y a' + Ry e_z t' - Ry Rz e_x f', which is inverted in closed
  // form.
  const double ca = std::cos(joint.angles.abduction), sa = std::sin(joint.angles.abduction);
  const double st = std::sin(joint.angles.twist);
  const double ct = std::copysign(std::max(std::abs(std::cos(joint.angles.twist)), 1e-3), std::cos(joint.angles.twist));
  joint.d_angles.row(0) << -ca / ct, 0, sa / ct;
  joint.d_angles.row(1) << -st / ct * ca, 1, st / ct * sa;
  joint.d_angles.row(2) << sa, 0, ca;
  return joint;
}

JointJacobians JointLinearisation::of_gap() const {
  JointJacobians J;
  J.child << -Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero();
  J.parent = point_jacobian(lever);
  return J;
}

JointJacobians JointLinearisation::of_turn() const {
  JointJacobians J;
  J.child << Eigen::Matrix3d::Zero(), R_camera_joint.transpose();
  J.parent = -J.child;
  return J;
}

JointJacobians JointLinearisation::of_angles() const {
  JointJacobians J = of_turn();
  J.child = d_angles * J.child;
  J.parent = -J.child;
  return J;
}

AngleExcess JointLinearisation::excess(const JointLimits& limits) const {
  const auto beyond = [](double x, double lo, double hi) { return x < lo ? x - lo : (x > hi ? x - hi : 0.0); };
  const double flexion = beyond(angles.flexion, limits.flexion_lo, limits.flexion_hi);
  const double abduction = beyond(angles.abduction, limits.abduction_lo, limits.abduction_hi);
  return {{flexion, abduction, angles.twist}, {flexion != 0 ? 1.0 : 0.0, abduction != 0 ? 1.0 : 0.0, 1}};
}

}  // namespace barehand
