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

namespace barehand::golden {

/// A message of each type with a different value in every field. Its encoded bytes are stored in
/// tests/golden/lcm/TYPE.bin.
rgbd_frame_t rgbd_frame();
hand_state_t hand_state();
glove_state_t glove_state();
hand_joints_t hand_joints();
contact_state_t contact_state();
grasp_state_t grasp_state();
object_state_t object_state();
health_t health();
command_t command();

}  // namespace barehand::golden
