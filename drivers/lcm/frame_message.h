#pragma once

#include "drivers/lcm/foreign_frames.h"
#include "drivers/lcm/wire.h"

namespace barehand {

/// Whether `hash` is the fingerprint of a message type that carries frames.
bool carries_frames(std::int64_t hash);

/// Decodes a message of any type that carries frames; the result has no other owner yet. `number` becomes the number of
/// frames of other projects' types, whose messages carry none.
Result<std::shared_ptr<RgbdFrame>> decode_frame_message(WireBytes message, const GivenIntrinsics& camera,
                                                        std::int64_t number);

}  // namespace barehand
