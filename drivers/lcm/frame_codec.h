#pragma once

#include "barehand/rgbd_frame_t.hpp"
#include "core/error.h"
#include "drivers/lcm/depth_codec.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// How rgbd_frame_t carries colour; the values are those of the message type. JPEG is lossy.
enum class ColourEncoding : std::int8_t { none = 0, raw_rgb = 1, jpeg = 2, png = 3 };

struct FrameEncoding {
  DepthEncoding depth = DepthEncoding::rvl_zstd;
  ColourEncoding colour = ColourEncoding::png;
  int jpeg_quality = 92;  ///< 1..100
};

/// The message of a frame; `seq` becomes the frame's number. A frame whose depth or colour differ in size from its
/// intrinsics is an error.
Result<rgbd_frame_t> encode_frame(const RgbdFrame& frame, const FrameEncoding& encoding);

/// The frame of a message. Sizes, intrinsics, depth unit and depth are checked; what lies is an error. Colour that lies
/// is left out, and the frame says why.
Result<std::shared_ptr<RgbdFrame>> decode_frame(const rgbd_frame_t& message);

}  // namespace barehand
