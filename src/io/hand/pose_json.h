#pragma once

#include <string>

#include "core/error.h"
#include "hand/hand_pose.h"

namespace barehand {

/// Reads an initial pose (docs/formats.md). It must name T_camera_segment of the palm; any other segment has either
/// its T_camera_segment or joint angles `flexion_deg` and `abduction_deg` from rest. Segments that are not named stay
/// at rest.
Result<HandPose> load_pose(const std::string& path, const HandProfile& profile);
/// Writes T_camera_segment of all segments.
Result<void> save_pose(const HandPose& pose, const std::string& path);

}  // namespace barehand
