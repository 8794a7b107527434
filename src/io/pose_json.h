#pragma once

#include <string>

#include "core/error.h"
#include "hand/hand_pose.h"

namespace barehand {

/// Reads an initial pose (docs/formats.md): the palm's T_camera_segment, and for any other segment either its
/// T_camera_segment or joint angles `flexion_deg`, `abduction_deg` from rest. What is not named stays at rest.
Result<HandPose> load_pose(const std::string& path, const HandProfile& profile);
/// Writes the transforms of all segments.
Result<void> save_pose(const HandPose& pose, const std::string& path);

}  // namespace barehand
