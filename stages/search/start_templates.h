#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "hand/articulated_pose.h"

namespace barehand {

/// A typical shape of the hand.
struct ShapeTemplate {
  std::string_view name;
  std::array<JointAngles, kSegmentCount> angles{};
};
/// The shapes open, spread, half-open, relaxed curl, grasp and loose fist; their angles are clamped to the limits.
std::vector<ShapeTemplate> shape_templates(const HandProfile& profile,
                                           const std::array<JointLimits, kSegmentCount>& limits);

/// R_camera_palm from three angles [rad]: `roll` about the finger axis (0: palm to the camera, pi: back to the camera),
/// then `pitch` (positive: fingers lean towards the camera), then `in_plane` about the optical axis (0: fingers up).
Eigen::Matrix3d palm_orientation(double roll, double pitch, double in_plane);

}  // namespace barehand
