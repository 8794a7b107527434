#pragma once

#include <string>
#include <vector>

#include "io/lcm/message_sink.h"
#include "sensor/rgbd_frame.h"
#include "stages/publish/hand_messages.h"

namespace barehand {

/// Writes one frame as `barehand record` does, on `<prefix>`RGBD_FRAME, and the states of its hands as the log of
/// states has them.
Result<void> record_frame(MessageSink& log, const std::string& prefix, const RgbdFrame& frame,
                          const std::vector<HandMessages>& hands);

}  // namespace barehand
