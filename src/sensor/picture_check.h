#pragma once

#include <cstdint>

#include "core/image.h"

namespace barehand {

/// What may be wrong with a depth image.
enum class DepthFault {
  none,
  incomplete,  ///< bytes are missing
  senseless,   ///< neighbours have nothing to do with each other: noise instead of surfaces
  repeated,    ///< bit for bit the image before; a living sensor's noise never repeats
  empty,       ///< nothing measured anywhere: covered lens, or nothing within range
};

/// Share of neighbouring pixels, both measured, whose depths differ by more than a fifth. Surfaces: a few percent.
double jump_share(const Image<std::uint16_t>& depth);

/// Of an image that is complete; `before` may be null.
DepthFault check_depth(const Image<std::uint16_t>& depth, const Image<std::uint16_t>* before);

}  // namespace barehand
