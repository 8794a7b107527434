#pragma once

#include "drivers/lcm/foreign_frames.h"
#include "drivers/lcm/wire.h"

namespace barehand {

/// True for the fingerprint of a message type that carries frames.
bool carries_frames(std::int64_t hash);

/// The frame in an encoded message of any of the known types, not shared with anyone yet. `number` is given to frames
/// of foreign types, whose messages carry none.
Result<std::shared_ptr<RgbdFrame>> decode_frame_message(WireBytes message, const GivenIntrinsics& camera,
                                                        std::int64_t number);

}  // namespace barehand
