#pragma once

#include <string>

#include "drivers/lcm/wire.h"

namespace barehand {

/// A message of a tracker in one line, as `barehand listen` prints it: hand_state_t, glove_state_t, contact_state_t,
/// grasp_state_t or object_state_t. Of any other message, and of a damaged one, it names the channel and the size.
std::string state_line(const std::string& channel, WireBytes message);

}  // namespace barehand
