#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "hand/joint_angles.h"

namespace barehand {

/// A hand by its palm pose and joint angles: every joint closed, within limits.
struct ArticulatedPose {
  SE3 T_camera_palm;
  std::array<JointAngles, kSegmentCount> angles{};
};
HandPose posed(const HandProfile& profile, const ArticulatedPose& articulated);
/// Joint angles read off a pose, clamped to the limits.
ArticulatedPose articulated_from(const HandProfile& profile, const HandPose& pose,
                                 const std::array<JointLimits, kSegmentCount>& limits);
void clamp_angles(std::array<JointAngles, kSegmentCount>& angles, const std::array<JointLimits, kSegmentCount>& limits);

/// A typical shape of the hand.
struct ShapeTemplate {
  std::string_view name;
  std::array<JointAngles, kSegmentCount> angles{};
};
/// Open, spread, half-open, relaxed curl, grasp and loose fist, within the limits.
std::vector<ShapeTemplate> shape_templates(const HandProfile& profile,
                                           const std::array<JointLimits, kSegmentCount>& limits);

/// Orientation of the palm: `roll` about the finger axis (0: palm to the camera, pi: back to the camera), then
/// `pitch` (positive: fingers lean towards the camera), then `in_plane` about the optical axis (0: fingers up).
Eigen::Matrix3d palm_orientation(double roll, double pitch, double in_plane);

}  // namespace barehand
