#pragma once

#include <array>

#include "hand/hand_pose.h"

namespace barehand {

// Joint angles, their limits, and forward kinematics.

/// Rotation of a joint away from its rest pose [rad]: flexion towards the palm, abduction about the segment's +y, twist
/// about its z. In the order R = Ry(abduction) Rz(twist) Rx(-flexion) there is no gimbal lock at 90 degrees of flexion,
/// and combined flexion and abduction have no twist.
struct JointAngles {
  double flexion = 0, abduction = 0, twist = 0;
};
/// The angles of the rotation R_rest_posed of a joint.
JointAngles joint_angles(const Eigen::Matrix3d& R_rest_posed);
/// The rotation R_rest_posed with these angles.
Eigen::Matrix3d joint_rotation(const JointAngles& angles);

/// Angles of the joint between `segment` and its parent in a pose; zeros for the palm.
JointAngles joint_angles(const HandProfile& profile, const HandPose& pose, int segment);

/// Allowed range of one joint [rad]; the only allowed twist is 0 (paper Sec. 3).
struct JointLimits {
  double flexion_lo = 0, flexion_hi = 0, abduction_lo = 0, abduction_hi = 0;
};
/// The profile's limits, widened by `widening` [rad] at both ends (paper Sec. 4.3: contact with objects enlarges the
/// ranges). A joint without abduction keeps the range [0, 0] for it.
std::array<JointLimits, kSegmentCount> widened_limits(const HandProfile& profile, double widening);

/// Places a segment at its joint on its parent, which must be in place, with these angles. The joint is closed exactly.
void place_segment(const HandProfile& profile, int segment, const JointAngles& angles, HandPose& pose);
/// The pose with the given palm pose and joint angles. All joints are closed exactly.
HandPose forward_kinematics(const HandProfile& profile, const SE3& T_camera_palm,
                            const std::array<JointAngles, kSegmentCount>& angles);
/// The ends of a segment in the camera frame [m].
Eigen::Vector3d proximal_end(const HandPose& pose, int segment);
Eigen::Vector3d distal_end(const HandProfile& profile, const HandPose& pose, int segment);
/// Position of the joint of `segment` as given by the parent's pose, in the camera frame [m]. The joint gap is the
/// distance from there to the segment's proximal end.
Eigen::Vector3d joint_in_parent(const HandProfile& profile, const HandPose& pose, int segment);

}  // namespace barehand
