#pragma once

#include <optional>

#include "hand/hand_pose.h"

namespace barehand {

/// Corrects fingers that cross. Hands seldom cross fingers, but a tracker that confuses two neighbouring ones does.
/// Returns the pose in which the two fingers are exchanged, so that they lie side by side; none if no fingers cross. In
/// the returned pose the joints are closed, and all angles are within the profile's limits widened by `widening` [rad].
std::optional<HandPose> uncrossed(const HandProfile& profile, const HandPose& pose, double widening);

}  // namespace barehand
