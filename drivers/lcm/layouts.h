#pragma once

#include "barehand/command_t.hpp"
#include "barehand/glove_state_t.hpp"
#include "barehand/hand_joints_t.hpp"
#include "barehand/hand_state_t.hpp"
#include "barehand/health_t.hpp"
#include "barehand/rgbd_frame_t.hpp"
#include "bot_core/images_t.hpp"
#include "drivers/lcm/wire.h"
#include "kinect/frame_msg_t.hpp"

namespace barehand {

/// Steps over the fields of a message type in the order of its .lcm file, which checks every length in it.
/// decode_message does this before it calls the generated decoder. There is one overload for every type that is
/// received.
void walk(WireWalker& walker, const rgbd_frame_t*);
void walk(WireWalker& walker, const command_t*);
void walk(WireWalker& walker, const hand_state_t*);
void walk(WireWalker& walker, const glove_state_t*);
void walk(WireWalker& walker, const hand_joints_t*);
void walk(WireWalker& walker, const health_t*);
void walk(WireWalker& walker, const kinect::frame_msg_t*);
void walk(WireWalker& walker, const bot_core::images_t*);

}  // namespace barehand
