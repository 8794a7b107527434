#pragma once

#include <cstdint>

#include "core/image.h"

namespace barehand {

/// What may be wrong with a depth image.
enum class DepthFault {
  none,
  incomplete,  ///< bytes are missing
  senseless,   ///< neighbouring depths are unrelated: noise instead of surfaces
  repeated,    ///< identical to the previous image; the noise of a working sensor never repeats
  empty,       ///< no pixel was measured: the lens is covered, or nothing is within range
};

/// Fraction of the pairs of horizontal neighbours, both measured, whose depths differ by more than a fifth. It is a few
/// percent for an image of surfaces. Returns 0 if there are too few pairs.
double jump_fraction(const Image<std::uint16_t>& depth);

/// Checks a depth image that is complete. `before` is the previous image, or null.
DepthFault check_depth(const Image<std::uint16_t>& depth, const Image<std::uint16_t>* before);

}  // namespace barehand
