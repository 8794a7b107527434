#pragma once

#include "hand/joint_angles.h"

namespace barehand {

// Derivatives of a joint's gap and angles with respect to the poses of its segments.

/// Jacobians of a quantity of a joint with respect to the boxplus twists (v, w) of the joint's segment and of its
/// parent.
struct JointJacobians {
  Eigen::Matrix<double, 3, 6> child, parent;
};

/// How far a joint is outside its limits (paper, Eq. 6): flexion and abduction beyond them, and all twist.
struct AngleExcess {
  Eigen::Vector3d angles;  ///< flexion, abduction, twist [rad]
  Eigen::Vector3d counts;  ///< 1 for an angle outside its limits, 0 for one within them
};

/// The state of one joint and its linearisation.
struct JointLinearisation {
  Eigen::Vector3d gap;    ///< joint position according to the parent minus the segment's own proximal end, camera frame
                          ///< [m] (paper, Eq. 5)
  Eigen::Vector3d lever;  ///< joint position according to the parent minus the parent's origin, camera frame [m]
  Eigen::Matrix3d R_camera_joint;   ///< orientation that the segment would have at zero angles
  Eigen::Matrix3d R_joint_segment;  ///< rotation of the joint away from rest
  JointAngles angles;               ///< joint angles of R_joint_segment
  /// Derivative of the angles with respect to a rotation in the joint's frame. Rows: flexion, abduction, twist.
  Eigen::Matrix3d d_angles;

  JointJacobians of_gap() const;     ///< derivative of the gap: v_parent + w_parent x lever - v_segment
  JointJacobians of_turn() const;    ///< derivative of R_joint_segment's rotation in the joint's frame
  JointJacobians of_angles() const;  ///< derivative of flexion, abduction and twist
  AngleExcess excess(const JointLimits& limits) const;  ///< how far the angles exceed `limits`
};
/// Linearises the joint between `segment`, which must not be the palm, and its parent.
JointLinearisation linearise_joint(const HandProfile& profile, const HandPose& pose, int segment);
/// Linearises the joint for the rest pose `rest` (T_parent_segment) instead of the profile's.
JointLinearisation linearise_joint(const SE3& rest, const HandPose& pose, int segment);

}  // namespace barehand
