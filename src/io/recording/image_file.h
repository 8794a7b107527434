#pragma once

#include <cstdint>
#include <string>

#include "core/error.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// 16-bit single-channel PNG, counts as stored. Missing, damaged or of another kind: an error naming the file.
Result<Image<std::uint16_t>> read_depth_png(const std::string& path);
/// 8-bit colour PNG or JPEG; a JPEG that ends early is an error, not a half grey picture.
Result<Image<Rgb>> read_colour(const std::string& path);
/// Error unless an image has the size that the camera states.
Result<void> check_size(int width, int height, const Intrinsics& camera, const std::string& path);

/// Lossless; a full disk is an error.
Result<void> write_depth_png(const std::string& path, const Image<std::uint16_t>& depth);
/// PNG (lossless) where `path` ends in .png, else JPEG of quality 95.
Result<void> write_colour(const std::string& path, const Image<Rgb>& colour);

}  // namespace barehand
