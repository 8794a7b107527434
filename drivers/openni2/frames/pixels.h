#pragma once

#include <OpenNI.h>

#include "core/image.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Whether a frame has the size, the stride and the number of bytes that its stream's mode promises.
bool complete(const openni::VideoFrameRef& frame, const openni::VideoMode& mode, int bytes_per_pixel);

/// Copies a complete depth frame; `mirror` exchanges left and right.
void copy_depth(const openni::VideoFrameRef& frame, bool mirror, Image<std::uint16_t>& depth);

/// Converts a complete frame of any format that colour_bytes_per_pixel() supports; `mirror` exchanges left and right.
void copy_colour(const openni::VideoFrameRef& frame, bool mirror, Image<Rgb>& colour);

/// Converts one row of `width` pixels.
void convert_colour_row(const std::uint8_t* in, int width, openni::PixelFormat format, Rgb* out);

}  // namespace barehand
