#pragma once

#include "hand/joint_angles.h"

namespace barehand {

/// First-order change of a quantity of a joint: child * twist of the segment + parent * twist of its parent, boxplus
/// twists (v, w).
struct JointJacobians {
  Eigen::Matrix<double, 3, 6> child, parent;
};

/// What a joint's limits do not allow (Eq. 6): flexion and abduction beyond them, and all twist.
struct AngleExcess {
  Eigen::Vector3d angles;  ///< flexion, abduction, twist [rad]
  Eigen::Vector3d counts;  ///< 1 of what is held back, 0 of an angle within its limits
};

/// State of one joint and its first-order change.
struct JointLinearisation {
  Eigen::Vector3d gap;              ///< joint in the parent minus proximal end, camera frame [m] (Eq. 5)
  Eigen::Vector3d lever;            ///< joint in the parent minus the parent's origin, camera frame [m]
  Eigen::Matrix3d R_camera_joint;   ///< the joint's frame: where the segment would be at zero angles
  Eigen::Matrix3d R_joint_segment;  ///< the joint's rotation away from rest
  JointAngles angles;               ///< of R_joint_segment (Eq. 6)
  Eigen::Matrix3d d_angles;         ///< of a turn in the joint's frame; rows: flexion, abduction, twist

  JointJacobians of_gap() const;     ///< v_parent + w_parent x lever - v_segment
  JointJacobians of_turn() const;    ///< of R_joint_segment, a turn in the joint's frame
  JointJacobians of_angles() const;  ///< of flexion, abduction, twist
  AngleExcess excess(const JointLimits& limits) const;
};
/// At the joint between `segment`, which is not the palm, and its parent.
JointLinearisation linearise_joint(const HandProfile& profile, const HandPose& pose, int segment);
/// The same with `rest`: T_parent_segment at rest.
JointLinearisation linearise_joint(const SE3& rest, const HandPose& pose, int segment);

}  // namespace barehand
