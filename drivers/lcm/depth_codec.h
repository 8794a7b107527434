#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/image.h"
#include "sensor/camera_limits.h"

namespace barehand {

/// The encodings of depth in rgbd_frame_t, with the values of the message type. All are lossless.
enum class DepthEncoding : std::int8_t { raw16 = 0, zlib = 1, rvl_zstd = 2 };

std::vector<std::uint8_t> encode_depth(const Image<std::uint16_t>& depth, DepthEncoding encoding);

/// Decodes an image of the given size. Errors: `bytes` are not exactly the code of such an image, or
/// possible_size(width, height) is false.
Result<Image<std::uint16_t>> decode_depth(std::span<const std::uint8_t> bytes, DepthEncoding encoding, int width,
                                          int height);

/// Returns an error if possible_size(width, height) is false.
Result<void> check_image_size(std::int64_t width, std::int64_t height);

}  // namespace barehand
