#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/image.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Decodes a JPEG in memory: grey, colour, or CMYK as Adobe writes it (inverted). Errors: damage that leaves rows
/// without pixels, an early end, a size other than `width` by `height`. Damage within the compressed data is not an
/// error: it makes some pixels wrong, and libjpeg continues after it.
Result<Image<Rgb>> decode_jpeg(std::span<const std::uint8_t> bytes, int width, int height);

/// Encodes an image as baseline JPEG with chroma at half the resolution. `quality`: 1 to 100. It is lossy: pure black
/// ("no colour here") may become dark grey. Errors: an image that is empty or too large for JPEG.
Result<std::vector<std::uint8_t>> encode_jpeg(const Image<Rgb>& image, int quality);

}  // namespace barehand
