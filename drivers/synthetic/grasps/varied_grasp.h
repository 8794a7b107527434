#pragma once

#include "drivers/synthetic/hand/hand_shape.h"
#include "drivers/synthetic/sequences/sequence.h"

namespace barehand::synthetic {

/// Seeds from this one on are for testing: they draw other objects than smaller seeds do.
inline constexpr std::uint64_t kFirstTestSeed = 1'000'000;

/// The hand of a person whom the seed draws: `shape`, with other proportions.
HandShape drawn_hand(const HandShape& shape, std::uint64_t seed);

/// A hand in front of a wall that reaches for an object in the air, grasps, lifts, turns and releases it. The seed
/// draws everything that `choice` leaves open, and the view. Errors: no such object or class of grasps; the object
/// cannot be held so.
Result<std::unique_ptr<Sequence>> make_varied_grasp(const HandRig& rig, const GraspChoice& choice, std::uint64_t seed);

}  // namespace barehand::synthetic
