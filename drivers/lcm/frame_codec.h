#pragma once

#include "barehand/rgbd_frame_t.hpp"
#include "core/error.h"
#include "drivers/lcm/depth_codec.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

// Conversion of frames to rgbd_frame_t messages and back.

/// The encodings of colour in rgbd_frame_t, with the values of the message type. Only JPEG is lossy.
enum class ColourEncoding : std::int8_t { none = 0, raw_rgb = 1, jpeg = 2, png = 3 };

struct FrameEncoding {
  DepthEncoding depth = DepthEncoding::rvl_zstd;
  ColourEncoding colour = ColourEncoding::png;
  int jpeg_quality = 92;  ///< quality of JPEG colour, 1 to 100
};

/// Encodes a frame; its number becomes `seq`. A frame whose depth or colour differs in size from its intrinsics is an
/// error.
Result<rgbd_frame_t> encode_frame(const RgbdFrame& frame, const FrameEncoding& encoding);

/// Decodes a message. Errors: an impossible size, implausible intrinsics or depth unit, damaged depth. Invalid colour
/// is left out, and the frame's `colour_fault` says why.
Result<std::shared_ptr<RgbdFrame>> decode_frame(const rgbd_frame_t& message);

}  // namespace barehand
