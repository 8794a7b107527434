#pragma once

#include "hand/joint_angles.h"

namespace barehand {

/// State of one joint and its derivative with respect to the boxplus twists of the segment and its parent.
/// With d the relative rotation increment in the joint's frame, d = R_camera_joint^T (w_segment - w_parent):
/// the angles change by d_angles * d. The gap changes by v_parent - lever x w_parent ... - v_segment.
struct JointLinearisation {
  Eigen::Vector3d gap;              ///< joint in the parent minus proximal end, camera frame [m] (Eq. 5)
  Eigen::Vector3d lever;            ///< joint in the parent minus the parent's origin, camera frame [m]
  Eigen::Matrix3d R_camera_joint;   ///< the joint's frame: where the segment would be at zero angles
  Eigen::Matrix3d R_joint_segment;  ///< the joint's rotation away from rest
  JointAngles angles;               ///< of R_joint_segment (Eq. 6)
  Eigen::Matrix3d d_angles;         ///< rows: flexion, abduction, twist
};
JointLinearisation linearise_joint(const HandProfile& profile, const HandPose& pose, int segment);

}  // namespace barehand
