#pragma once

#include <vector>

#include "hand/profile.h"

namespace barehand::synthetic {

/// Degrees of freedom of a segment's joint in the order applied, with the ranges of a free hand. Flexion counts towards
/// the palm; abduction away from the middle finger (the middle finger's own: towards the index), the thumb's out of
/// the palm's plane.
std::vector<JointDof> joint_dofs(int segment, Handedness handedness);

}  // namespace barehand::synthetic
