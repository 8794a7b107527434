#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/image.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Decodes a PNG in memory to 8 bits per channel: palettes, grey and 1, 2, 4 or 16 bits are converted, transparency is
/// dropped. Errors: damage, an early end, a size other than `width` by `height`.
Result<Image<Rgb>> decode_png_colour(std::span<const std::uint8_t> bytes, int width, int height);
/// Decodes a PNG with one channel of 16 bits; the values are returned as stored. Errors: those of decode_png_colour(),
/// and any other kind of PNG.
Result<Image<std::uint16_t>> decode_png_depth(std::span<const std::uint8_t> bytes, int width, int height);

/// Encodes an image as PNG with 8 bits per channel, compressed for speed, since live cameras are recorded with it.
/// Error: an empty image.
Result<std::vector<std::uint8_t>> encode_png(const Image<Rgb>& image);
/// Encodes a depth image as PNG with one channel of 16 bits. Error: an empty image.
Result<std::vector<std::uint8_t>> encode_png(const Image<std::uint16_t>& image);

}  // namespace barehand
