#pragma once

#include <string>

#include "hand/profile.h"

namespace barehand::ros {

/// A hand with its lengths, joints and limits as a robot (URDF) whose links are the frames of add_transforms and whose
/// joints are those of joint_state: zero is the rest pose, and the palm is the root. A joint with two degrees of
/// freedom has a link without size between them.
std::string urdf(const HandProfile& profile);

}  // namespace barehand::ros
