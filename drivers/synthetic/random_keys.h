#pragma once

#include <cstdint>

namespace barehand::synthetic {

/// What a random number is for: the last word of its key, so that no two purposes share draws.
enum class Draw : std::uint32_t { grain = 1, depth_noise = 2, holes = 3, tremor = 4, variation = 5 };

}  // namespace barehand::synthetic
