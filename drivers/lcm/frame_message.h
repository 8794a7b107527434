#pragma once

#include "drivers/lcm/foreign_frames.h"
#include "drivers/lcm/wire.h"

namespace barehand {

/// True for the fingerprint of a message type that carries frames.
bool carries_frames(std::int64_t hash);

/// The frame in an encoded message of any of the known types. `number` is given to frames of foreign types, whose
/// messages carry none.
Result<FramePtr> decode_frame_message(WireBytes message, const ForeignCamera& camera, std::int64_t number);

}  // namespace barehand
