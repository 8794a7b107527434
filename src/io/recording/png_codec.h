#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/image.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Decodes a PNG in memory to 8 bits a channel: palettes, grey and 1, 2, 4 or 16 bits are converted, transparency is
/// dropped. Errors: damage, an early end, a size other than `width` by `height`, for which memory is allocated.
Result<Image<Rgb>> decode_png_colour(std::span<const std::uint8_t> bytes, int width, int height);
/// Decodes a PNG of one channel of 16 bits, to counts as stored. Errors: as above, and any other kind of PNG.
Result<Image<std::uint16_t>> decode_png_depth(std::span<const std::uint8_t> bytes, int width, int height);

/// Lossless, 8 bits a channel, compressed for speed: cameras are recorded with it. Error: an empty image.
Result<std::vector<std::uint8_t>> encode_png(const Image<Rgb>& image);
/// Lossless, one channel of 16 bits. Error: an empty image.
Result<std::vector<std::uint8_t>> encode_png(const Image<std::uint16_t>& image);

}  // namespace barehand
