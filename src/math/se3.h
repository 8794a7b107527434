#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace barehand {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A rigid motion x -> R x + t with R in SO(3). `T_a_b` maps coordinates in frame b to coordinates in frame a.
/// Increments are twists (v, w): first the translation [m], then the rotation vector [rad].
struct SE3 {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return R * p + t; }
  SE3 operator*(const SE3& b) const { return {R * b.R, R * b.t + t}; }
  SE3 inverse() const { return {R.transpose(), -(R.transpose() * t)}; }
  /// The homogeneous 4x4 matrix.
  Eigen::Matrix4d matrix() const;
  bool all_finite() const { return R.allFinite() && t.allFinite(); }
};

/// The matrix with skew(w) x = w x x (cross product).
Eigen::Matrix3d skew(const Eigen::Vector3d& w);
/// Derivative of a point of a body with respect to the body's boxplus twist; `arm`: the point minus the body's origin.
Eigen::Matrix<double, 3, 6> point_jacobian(const Eigen::Vector3d& arm);
/// Rotation matrix of a rotation vector (Rodrigues' formula), with the exact limit at w = 0.
Eigen::Matrix3d exp_so3(const Eigen::Vector3d& w);
/// Rotation vector of a rotation matrix, with an angle in [0, pi].
Eigen::Vector3d log_so3(const Eigen::Matrix3d& R);
/// Moves a frame about its own origin: R <- exp(w) R, t <- t + v, where (v, w) is expressed in the outer (camera)
/// frame. All Jacobians of the project use this chart, which decouples translation and rotation.
SE3 boxplus(const SE3& T, const Vector6d& twist);
/// The twist for which boxplus(a, twist) = b.
Vector6d boxminus(const SE3& b, const SE3& a);
/// A rotation close to R, which must be nearly orthonormal. Removes the rounding drift of repeated products.
Eigen::Matrix3d orthonormalised(const Eigen::Matrix3d& R);

}  // namespace barehand
