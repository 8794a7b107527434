#pragma once

#include "drivers/synthetic/people/staged_sequence.h"
#include "math/random.h"

namespace barehand::synthetic {

inline constexpr double kHandlessDuration = 20, kHandlessStep = 2.5;  ///< s; between the keys of what moves

/// A scene without a hand before a camera that moves slowly.
StagedSequence::Setting handless_setting(std::uint64_t seed, KeyedRandom& random);

}  // namespace barehand::synthetic
