#pragma once

#include <span>
#include <string>

#include "barehand/object_state_t.hpp"
#include "io/lcm/message_sink.h"
#include "sensor/rgbd_frame.h"
#include "stages/publish/hand_messages.h"

namespace barehand {

/// Writes one frame on the channel `<prefix>`RGBD_FRAME, like `barehand record`, and the messages of its hands and
/// objects, like StatesLogSink.
Result<void> record_frame(MessageSink& log, const std::string& prefix, const RgbdFrame& frame,
                          std::span<const HandMessages> hands, std::span<const object_state_t> objects);

}  // namespace barehand
