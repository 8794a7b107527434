#pragma once

#include "hand/joint_angles.h"

namespace barehand {

/// State of one joint and its first-order change under the boxplus twists (v, w) of the segment and of its parent:
///   d_gap    = v_parent + w_parent x lever - v_segment
///   d_angles * R_camera_joint^T (w_segment - w_parent) = changes of flexion, abduction and twist
struct JointLinearisation {
  Eigen::Vector3d gap;              ///< joint in the parent minus proximal end, camera frame [m] (Eq. 5)
  Eigen::Vector3d lever;            ///< joint in the parent minus the parent's origin, camera frame [m]
  Eigen::Matrix3d R_camera_joint;   ///< the joint's frame: where the segment would be at zero angles
  Eigen::Matrix3d R_joint_segment;  ///< the joint's rotation away from rest
  JointAngles angles;               ///< of R_joint_segment (Eq. 6)
  Eigen::Matrix3d d_angles;         ///< of a turn in the joint's frame; rows: flexion, abduction, twist
};
/// At the joint between `segment`, which is not the palm, and its parent.
JointLinearisation linearise_joint(const HandProfile& profile, const HandPose& pose, int segment);

}  // namespace barehand
