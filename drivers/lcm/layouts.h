#pragma once

#include "barehand/command_t.hpp"
#include "barehand/contact_state_t.hpp"
#include "barehand/glove_state_t.hpp"
#include "barehand/grasp_state_t.hpp"
#include "barehand/hand_joints_t.hpp"
#include "barehand/hand_state_t.hpp"
#include "barehand/health_t.hpp"
#include "barehand/object_state_t.hpp"
#include "barehand/rgbd_frame_t.hpp"
#include "bot_core/images_t.hpp"
#include "drivers/lcm/wire.h"
#include "kinect/frame_msg_t.hpp"

namespace barehand {

/// Steps `walker` over the fields of an encoded message, in the order of the .lcm file, and so checks every length in
/// the message. decode_message() calls this before the generated decoder, which trusts the lengths. One overload per
/// received type; the pointer only selects it and may be null.
void walk(WireWalker& walker, const rgbd_frame_t*);
void walk(WireWalker& walker, const command_t*);
void walk(WireWalker& walker, const hand_state_t*);
void walk(WireWalker& walker, const glove_state_t*);
void walk(WireWalker& walker, const hand_joints_t*);
void walk(WireWalker& walker, const contact_state_t*);
void walk(WireWalker& walker, const grasp_state_t*);
void walk(WireWalker& walker, const object_state_t*);
void walk(WireWalker& walker, const health_t*);
void walk(WireWalker& walker, const kinect::frame_msg_t*);
void walk(WireWalker& walker, const bot_core::images_t*);

}  // namespace barehand
