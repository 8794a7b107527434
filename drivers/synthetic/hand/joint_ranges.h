#pragma once

#include <vector>

#include "hand/profile.h"

namespace barehand::synthetic {

/// Degrees of freedom of a segment's joint, in the order in which they are applied, with the ranges of a hand that
/// touches nothing.
/// Flexion is positive towards the palm; abduction is positive away from the middle finger (for the middle finger:
/// towards the index; for the thumb: out of the palm's plane).
std::vector<JointDof> joint_dofs(int segment, Handedness handedness);

}  // namespace barehand::synthetic
