#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/image.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Decodes a JPEG in memory: grey, colour, or CMYK as Adobe writes it (inverted). Errors: damage that leaves rows
/// without pixels, an early end, a size other than `width` by `height`, for which memory is allocated. Damage within
/// the compressed data spoils pixels, not the whole image: libjpeg continues after it.
Result<Image<Rgb>> decode_jpeg(std::span<const std::uint8_t> bytes, int width, int height);

/// `quality` 1..100; baseline, chroma at half the resolution. Lossy: pure black ("no colour here") may turn dark grey.
/// Errors: an empty image, one too large for JPEG.
Result<std::vector<std::uint8_t>> encode_jpeg(const Image<Rgb>& image, int quality);

}  // namespace barehand
