#pragma once

#include <array>

#include "hand/hand_pose.h"

namespace barehand {

/// Rotation of a joint away from its rest pose [rad]: flexion towards the palm, abduction about +y of the segment,
/// twist about z. R = Ry(abduction) Rz(twist) Rx(-flexion): no gimbal lock at 90 degrees of flexion, no false twist.
struct JointAngles {
  double flexion = 0, abduction = 0, twist = 0;
};
JointAngles joint_angles(const Eigen::Matrix3d& R_rest_posed);
Eigen::Matrix3d joint_rotation(const JointAngles& angles);

/// Angles of `segment` against its parent in a pose (palm: zeros).
JointAngles joint_angles(const HandProfile& profile, const HandPose& pose, int segment);

/// Allowed range of one joint [rad]; twist is always allowed only at 0 (paper Sec. 3).
struct JointLimits {
  double flexion_lo = 0, flexion_hi = 0, abduction_lo = 0, abduction_hi = 0;
};
/// The profile's limits widened on both sides (paper Sec. 4.3: ranges are enlarged in contact with objects);
/// a joint without abduction keeps the range [0, 0] for it.
std::array<JointLimits, kSegmentCount> widened_limits(const HandProfile& profile, double widening);

/// Articulated pose: every joint closed exactly.
HandPose forward_kinematics(const HandProfile& profile, const SE3& T_camera_palm,
                            const std::array<JointAngles, kSegmentCount>& angles);
/// Both ends of a segment in the camera frame.
Eigen::Vector3d proximal_end(const HandPose& pose, int segment);
Eigen::Vector3d distal_end(const HandProfile& profile, const HandPose& pose, int segment);
/// Where the parent says that the joint of `segment` lies; the joint gap is its distance to the proximal end.
Eigen::Vector3d joint_in_parent(const HandProfile& profile, const HandPose& pose, int segment);

}  // namespace barehand
