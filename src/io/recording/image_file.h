#pragma once

#include <cstdint>
#include <string>

#include "core/error.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Reads a PNG with one channel of 16 bits; the values are returned as stored. Errors: the file is missing, damaged or
/// of another kind; the message names the file.
Result<Image<std::uint16_t>> read_depth_png(const std::string& path);
/// Reads an 8-bit colour PNG or JPEG. A truncated JPEG is an error; it is not filled up with grey.
Result<Image<Rgb>> read_colour(const std::string& path);
/// Returns an error unless an image has the size that the camera states.
Result<void> check_size(int width, int height, const Intrinsics& camera, const std::string& path);

/// Writes a PNG, which is lossless. A full disk is an error.
Result<void> write_depth_png(const std::string& path, const Image<std::uint16_t>& depth);
/// Writes a PNG (lossless) if `path` ends in .png, otherwise a JPEG of quality 95.
Result<void> write_colour(const std::string& path, const Image<Rgb>& colour);

}  // namespace barehand
