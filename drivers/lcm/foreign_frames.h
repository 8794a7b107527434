#pragma once

#include "bot_core/images_t.hpp"
#include "kinect/frame_msg_t.hpp"
#include "sensor/given_intrinsics.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

// Decodes frame types of other projects. They carry no intrinsics: `camera` must contain them, or every frame is an
// error.

// Colour that is damaged, or that differs in size from depth and so is not registered to it, is left out; the frame's
// `colour_fault` says why.

/// Reads depth in millimetres, raw or zlib (anything else is an error), and colour as raw RGB or JPEG.
Result<std::shared_ptr<RgbdFrame>> decode_kinect(const kinect::frame_msg_t& message, const GivenIntrinsics& camera,
                                                 std::int64_t number);

/// Reads the depth image DEPTH_MM or DEPTH_MM_ZIPPED and, where there is one, the colour image LEFT (RGB, BGR, grey or
/// JPEG).
Result<std::shared_ptr<RgbdFrame>> decode_images(const bot_core::images_t& message, const GivenIntrinsics& camera,
                                                 std::int64_t number);

}  // namespace barehand
