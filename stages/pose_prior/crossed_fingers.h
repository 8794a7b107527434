#pragma once

#include <optional>

#include "hand/hand_pose.h"

namespace barehand {

/// A tracker that takes two neighbouring fingers for one another ends with fingers that cross, which hands hardly do:
/// the pose in which such a pair lies side by side, each finger where the other one was. None where no fingers cross.
/// Joints come out closed, angles within the profile's limits widened by `widening` [rad].
std::optional<HandPose> uncrossed(const HandProfile& profile, const HandPose& pose, double widening);

}  // namespace barehand
