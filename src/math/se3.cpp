// Rigid motions: exponential map, logarithm and derivatives.
#include "math/se3.h"

#include <cmath>

namespace barehand {

Eigen::Matrix4d SE3::matrix() const {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = R;
  m.topRightCorner<3, 1>() = t;
  return m;
}

Eigen::Matrix3d skew(const Eigen::Vector3d& w) {
  Eigen::Matrix3d m;
  m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return m;
}

Eigen::Matrix<double, 3, 6> point_jacobian(const Eigen::Vector3d& arm) {
  Eigen::Matrix<double, 3, 6> J;
  J << Eigen::Matrix3d::Identity(), -skew(arm);
  return J;
}

Eigen::Matrix3d exp_so3(const Eigen::Vector3d& w) {
  const double angle_sq = w.squaredNorm();
  const Eigen::Matrix3d W = skew(w);
  if (angle_sq < 1e-12) return Eigen::Matrix3d::Identity() + W + 0.5 * W * W;
  const double angle = std::sqrt(angle_sq);
  return Eigen::Matrix3d::Identity() + std::sin(angle) / angle * W + (1 - std::cos(angle)) / angle_sq * W * W;
}

Eigen::Vector3d log_so3(const Eigen::Matrix3d& R) {
  // The logarithm by way of the quaternion is well conditioned at angles of both 0 and pi.
  Eigen::Quaterniond q(R);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine < 1e-9) return 2 * q.vec() / q.w();
  return 2 * std::atan2(sine, q.w()) / sine * q.vec();
}

SE3 boxplus(const SE3& T, const Vector6d& twist) { return {exp_so3(twist.tail<3>()) * T.R, T.t + twist.head<3>()}; }

Vector6d boxminus(const SE3& b, const SE3& a) {
  Vector6d twist;
  twist << b.t - a.t, log_so3(b.R * a.R.transpose());
  return twist;
}

Eigen::Matrix3d orthonormalised(const Eigen::Matrix3d& R) {
  return Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

}  // namespace barehand
