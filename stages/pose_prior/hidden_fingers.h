#pragma once

#include <array>

#include "hand/joint_angles.h"

namespace barehand {

// A prior for fingers that no data shows: they mostly bend with their neighbours, since a grasp closes all fingers and
// since their tendons are coupled (enslaving: Zatsiorsky, Li and Latash, Exp. Brain Res. 131, 2000).

/// Sets the hidden joints of a pose that a search found to neutral angles: a hidden finger is bent at its root like the
/// nearest fingers that are seen, and each further hidden joint like the joint before it, but the last joint by only
/// two thirds of the angle of the one before it.
HandPose with_hidden_neutral(const HandProfile& profile, const HandPose& pose,
                             const std::array<bool, kSegmentCount>& seen);

/// Returns `now` with the hidden parts of the fingers moved like the visible parts. A joint that is hidden together
/// with all joints after it bends by as much as the same joints of the nearest seen fingers have bent since `before`,
/// `dt` [s] ago, within the profile's limits widened by `widening` [rad]. Any other difference from these joints decays
/// within seconds. If only the thumb is seen, all fingers bend with it, since a grasp closes all digits at once. The
/// thumb and everything seen stay unchanged, and so do the fingers that rest on an object (`stays`). `shown`: the
/// fraction of each segment's skin that matches data.
HandPose with_hidden_following(const HandProfile& profile, const HandPose& before, const HandPose& now, double dt,
                               const std::array<bool, kSegmentCount>& seen,
                               const std::array<double, kSegmentCount>& shown,
                               const std::array<bool, kFingerCount>& stays, double widening);

}  // namespace barehand
