#pragma once

#include <string>

#include "hand/profile.h"

namespace barehand::ros {

/// The description of a hand as a robot (URDF), with its lengths, joints and limits. Its links are the frames of
/// add_transforms() with the palm as the root; its joints are those of joint_state(), which are zero in the rest pose.
/// A joint with two degrees of freedom becomes two hinges with an empty link between them.
std::string urdf(const HandProfile& profile);

}  // namespace barehand::ros
