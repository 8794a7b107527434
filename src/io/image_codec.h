#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/error.h"
#include "math/frame.h"

namespace barehand {

struct ImageSize {
  int width = 0, height = 0;
  bool operator==(const ImageSize&) const = default;
};

/// Size that the header of a PNG or JPEG in memory states, without decoding it. An error if it is neither.
Result<ImageSize> compressed_image_size(std::span<const std::uint8_t> bytes);

/// Decodes an 8-bit PNG or JPEG in memory. The header is compared with `expected` first, so a lying or foreign image
/// is an error before memory is spent on it.
Result<Image<Rgb>> decode_image(std::span<const std::uint8_t> bytes, ImageSize expected);

Result<std::vector<std::uint8_t>> encode_png(const Image<Rgb>& image);
/// `quality` 1..100. Lossy: pure black ("no colour here") may turn dark grey.
Result<std::vector<std::uint8_t>> encode_jpeg(const Image<Rgb>& image, int quality);

}  // namespace barehand
