#pragma once

#include "drivers/lcm/foreign_frames.h"
#include "drivers/lcm/wire.h"

namespace barehand {

/// True for the fingerprint of a message type that carries frames.
bool carries_frames(std::int64_t hash);

/// Of a frame at `utime` [us] after the one at `last` of its channel: it repeats that one or was overtaken on the way.
/// One that is older by a second or more is neither: the sender started again, or its clock was set back.
bool is_stale(std::int64_t utime, std::int64_t last);

/// The frame in an encoded message of any of the known types. `number` is given to frames of foreign types, whose
/// messages carry none.
Result<FramePtr> decode_frame_message(WireBytes message, const GivenIntrinsics& camera, std::int64_t number);

}  // namespace barehand
