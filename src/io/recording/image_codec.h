#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/error.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

struct ImageSize {
  int width = 0, height = 0;
  bool operator==(const ImageSize&) const = default;
};

/// Size that the header of a PNG or JPEG in memory states, without decoding it. An error if it is neither.
Result<ImageSize> compressed_image_size(std::span<const std::uint8_t> bytes);

/// Decodes an 8-bit PNG or JPEG in memory. The header is compared with `expected` first, so a wrong image is an error
/// before memory is allocated for it.
Result<Image<Rgb>> decode_image(std::span<const std::uint8_t> bytes, ImageSize expected);

/// Decodes a PNG in memory with one channel of 16 bits; the values are returned as stored. A JPEG or another kind of
/// PNG is an error.
Result<Image<std::uint16_t>> decode_depth_image(std::span<const std::uint8_t> bytes);

}  // namespace barehand
