#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/error.h"

namespace barehand {

/// RVL (Wilson, "Fast lossless depth image compression", ISS 2017): the image as runs of zeros and of measured pixels;
/// a measured pixel as its difference to the last one. Numbers are cut into 3 bits a nibble, lowest first, the fourth
/// bit says that more follow. Here the nibbles fill bytes high half first, so that the code is the same on any machine.
std::vector<std::uint8_t> rvl_encode(std::span<const std::uint16_t> counts);

/// Fills `counts` completely; code that is too short, too long or makes no sense is an error.
Result<void> rvl_decode(std::span<const std::uint8_t> code, std::span<std::uint16_t> counts);

/// Upper bound of the code of an image [bytes]: 17 bits per difference are at most 6 nibbles, and a run costs less
/// than the pixels that it starts.
constexpr std::size_t rvl_bound(std::size_t pixels) { return 4 * pixels + 16; }

}  // namespace barehand
