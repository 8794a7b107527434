#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/error.h"

namespace barehand {

/// Encodes depth with RVL (Wilson, "Fast lossless depth image compression", ISS 2017). Runs of zeros alternate with
/// runs of measured pixels; a measured pixel is coded as its difference to the previous one. A number is cut into
/// nibbles with 3 bits each, lowest first; the fourth bit says that more follow. Here the nibbles fill bytes instead of
/// 32-bit words, high half first, so that the code is the same on any machine.
std::vector<std::uint8_t> rvl_encode(std::span<const std::uint16_t> counts);

/// Decodes an image and fills all of `counts`. Code that is too short, too long or invalid is an error.
Result<void> rvl_decode(std::span<const std::uint8_t> code, std::span<std::uint16_t> counts);

/// Upper bound of the code's size [bytes]. Per pixel, a difference of 17 bits takes at most 6 nibbles, and the lengths
/// of the runs take at most 2.
constexpr std::size_t rvl_bound(std::size_t pixels) { return 4 * pixels + 16; }

}  // namespace barehand
