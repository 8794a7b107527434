#pragma once

#include <cstdint>

#include "math/random.h"

namespace barehand::synthetic {

/// The purpose of a random number. It is the last word of the number's key, so that no two purposes share numbers.
enum class Draw : std::uint32_t { grain = 1, depth_noise = 2, holes = 3, tremor = 4, variation = 5, scene = 6 };

/// The random numbers that determine the bodies, objects and motions of a scene.
inline KeyedRandom scene_random(std::uint64_t seed) { return {seed, 0, 0, static_cast<std::uint32_t>(Draw::scene)}; }

}  // namespace barehand::synthetic
