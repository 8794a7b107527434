#pragma once

#include "bot_core/images_t.hpp"
#include "kinect/frame_msg_t.hpp"
#include "sensor/given_intrinsics.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

// Other projects' frame types leave out the intrinsics: without `camera` their frames are errors.

// Colour that is damaged, or of another size and so not registered to depth, is left out, and the frame says why.

/// Depth in millimetres, raw or zlib; anything else is an error. Colour raw RGB or JPEG.
Result<std::shared_ptr<RgbdFrame>> decode_kinect(const kinect::frame_msg_t& message, const GivenIntrinsics& camera,
                                                 std::int64_t number);

/// The images DEPTH_MM or DEPTH_MM_ZIPPED and, where there is one, LEFT as RGB, BGR, grey or JPEG.
Result<std::shared_ptr<RgbdFrame>> decode_images(const bot_core::images_t& message, const GivenIntrinsics& camera,
                                                 std::int64_t number);

}  // namespace barehand
