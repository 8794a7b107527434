// Decodes a message of any type that carries frames, by its fingerprint.
#include "drivers/lcm/frame_message.h"

#include "drivers/lcm/frame_codec.h"
#include "drivers/lcm/layouts.h"

namespace barehand {

bool carries_frames(std::int64_t hash) {
  return hash == rgbd_frame_t::getHash() || hash == kinect::frame_msg_t::getHash() ||
         hash == bot_core::images_t::getHash();
}

Result<std::shared_ptr<RgbdFrame>> decode_frame_message(WireBytes message, const GivenIntrinsics& camera,
                                                        std::int64_t number) {
  // The hash at the start of a message tells its type.
  const std::int64_t hash = message_hash(message);
  if (hash == rgbd_frame_t::getHash()) {
    const auto decoded = decode_message<rgbd_frame_t>(message);
    return decoded ? decode_frame(*decoded) : tl::unexpected(decoded.error());
  }

  // The types of other programs carry no intrinsics, so those of the configuration are used.
  if (hash == kinect::frame_msg_t::getHash()) {
    const auto decoded = decode_message<kinect::frame_msg_t>(message);
    return decoded ? decode_kinect(*decoded, camera, number) : tl::unexpected(decoded.error());
  }
  if (hash == bot_core::images_t::getHash()) {
    const auto decoded = decode_message<bot_core::images_t>(message);
    return decoded ? decode_images(*decoded, camera, number) : tl::unexpected(decoded.error());
  }

  // No other type carries frames.
  return fail("message is of a type that carries no frames", "",
              "known are barehand.rgbd_frame_t, kinect.frame_msg_t and bot_core.images_t");
}

}  // namespace barehand
