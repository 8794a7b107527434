#pragma once

#include "bot_core/images_t.hpp"
#include "kinect/frame_msg_t.hpp"
#include "math/frame.h"
#include "math/given_intrinsics.h"

namespace barehand {

// Other projects' frame types leave out the intrinsics: without `camera` their frames are errors.

/// Depth in millimetres, raw or zlib; colour raw RGB or JPEG of the same size (colour of another size cannot be
/// registered to the depth and is left out). Anything else is an error.
Result<FramePtr> decode_kinect(const kinect::frame_msg_t& message, const GivenIntrinsics& camera, std::int64_t number);

/// The images DEPTH_MM or DEPTH_MM_ZIPPED and, where there is one of the same size, LEFT as RGB, BGR, grey or JPEG.
Result<FramePtr> decode_images(const bot_core::images_t& message, const GivenIntrinsics& camera, std::int64_t number);

}  // namespace barehand
