#pragma once

#include "drivers/lcm/frame_codec.h"
#include "drivers/lcm/frame_message.h"
#include "fuzz/message.h"
#include "sensor/camera_limits.h"

namespace barehand::fuzz {

/// Decodes the input as a frame message of this type. The images of an accepted frame must have the size that the frame
/// states, and its depth must survive encoding and decoding.
template <class Message>
void frame_from(const std::uint8_t* data, std::size_t size) {
  const GivenIntrinsics camera{500, 500, 3, 2};
  const auto frame = decode_frame_message(message_of<Message>(data, size), camera, 0);
  if (!frame) return;

  // A frame that is decoded must be consistent in itself.
  const RgbdFrame& f = **frame;
  CHECK(plausible(f.camera) && f.depth_unit > 0);
  CHECK(f.depth.width() == f.camera.width && f.depth.height() == f.camera.height);
  CHECK(f.colour.empty() || (f.colour.width() == f.camera.width && f.colour.height() == f.camera.height));
  CHECK(f.depth.size() == static_cast<std::size_t>(f.camera.width) * f.camera.height);
  if (f.depth.size() > 4096) return;  // more pixels take long and test nothing else

  // It must survive being encoded and decoded again.
  const auto sent = encode_frame(f, {DepthEncoding::rvl_zstd, ColourEncoding::raw_rgb});
  CHECK(sent.has_value());
  const auto received = decode_frame(*sent);
  CHECK(received.has_value());
  for (std::size_t i = 0; i < f.depth.size(); ++i) CHECK((*received)->depth[i] == f.depth[i]);
}

}  // namespace barehand::fuzz
