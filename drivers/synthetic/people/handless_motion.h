#pragma once

#include "drivers/synthetic/people/staged_sequence.h"
#include "math/random.h"

namespace barehand::synthetic {

inline constexpr double kHandlessDuration = 20,  ///< duration of a scene without a hand [s]
    kHandlessStep = 2.5;                         ///< time between two keyframes of its motions [s]

/// A scene without a hand and without objects yet, in front of a camera that moves slowly.
StagedSequence::Setting handless_setting(std::uint64_t seed, KeyedRandom& random);

}  // namespace barehand::synthetic
