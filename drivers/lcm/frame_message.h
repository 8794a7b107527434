#pragma once

#include "drivers/lcm/foreign_frames.h"
#include "drivers/lcm/wire.h"

namespace barehand {

/// Whether `hash` is the fingerprint of a message type that carries frames.
bool carries_frames(std::int64_t hash);

/// Decodes a message of any of these types into a frame that has no other owner yet. `number` is given to frames of
/// foreign types, whose messages carry no number.
Result<std::shared_ptr<RgbdFrame>> decode_frame_message(WireBytes message, const GivenIntrinsics& camera,
                                                        std::int64_t number);

}  // namespace barehand
