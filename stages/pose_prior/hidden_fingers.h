#pragma once

#include <array>

#include "hand/joint_angles.h"

namespace barehand {

/// What is known of fingers that no data shows: they mostly bend with their neighbours, as a grasp closes all of them
/// and one finger's tendons pull at the next (enslaving: Zatsiorsky, Li and Latash, Exp. Brain Res. 131, 2000).

/// A pose that was found by a search, with its hidden joints at ease: a hidden finger is bent at its root like the
/// nearest ones that are seen, a hidden joint of a finger like the joint before it, at the tip by two thirds of that.
HandPose with_hidden_neutral(const HandProfile& profile, const HandPose& pose,
                             const std::array<bool, kSegmentCount>& seen);

/// `now` with every finger that is hidden, or hidden from some joint on, bent on there by as much as the nearest ones
/// that are seen have bent since `before`, `dt` [s] ago, within the profile's limits widened by `widening` [rad]. How
/// it was bent otherwise is forgotten within seconds: it comes to be bent like them. Where no finger is seen, all bend
/// with a thumb that is, as a grasp closes all digits at once. The thumb and what is seen stay. `shown`: the fraction
/// of each segment's skin that data shows.
HandPose with_hidden_following(const HandProfile& profile, const HandPose& before, const HandPose& now, double dt,
                               const std::array<bool, kSegmentCount>& seen,
                               const std::array<double, kSegmentCount>& shown, double widening);

}  // namespace barehand
