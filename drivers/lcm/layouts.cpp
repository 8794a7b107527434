// The layouts of the LCM types, with which the lengths in a message are checked before it is decoded.
#include "drivers/lcm/layouts.h"

namespace barehand {
namespace {

constexpr int kDouble = 8;

/// The fields with which every hand message starts: utime, frame_number, sensor, hand_id, handedness, status.
void walk_hand_header(WireWalker& walker) {
  walker.skip(8 + 8);
  walker.string();
  walker.skip(4 + 1 + 1);
}

void walk_image(WireWalker& walker) {
  walker.skip(8 + 4 * 4);
  walker.byte_array();
  for (std::int32_t n = walker.count(9); n > 0 && walker.ok(); --n) {
    walker.string();
    walker.byte_array();
  }
}

}  // namespace

void walk(WireWalker& walker, const rgbd_frame_t*) {
  walker.skip(8 + 8);
  walker.string();
  walker.skip(4 + 4 + 5 * kDouble + 1);
  walker.byte_array();
  walker.skip(1);
  walker.byte_array();
}

void walk(WireWalker& walker, const command_t*) {
  walker.skip(8);
  walker.string();
  walker.skip(4 + 1 + 16 * (3 + 4) * kDouble);
  walker.string();
}

void walk(WireWalker& walker, const hand_state_t*) {
  walk_hand_header(walker);
  walker.skip(1 + 8 + 2 * kDouble);
  walker.skip(16 * ((2 * (3 + 4 + 3) + 3 + 3 + 36 + 2) * kDouble + 1));
}

void walk(WireWalker& walker, const glove_state_t*) {
  walk_hand_header(walker);
  for (int joint = 0; joint < 21; ++joint) walker.string();
  walker.skip((21 + 22) * (2 * kDouble + 1));
}

void walk(WireWalker& walker, const hand_joints_t*) {
  walk_hand_header(walker);
  walker.skip(26 * ((3 + 4 + 1) * kDouble + 4));
}

void walk(WireWalker& walker, const contact_state_t*) {
  walk_hand_header(walker);
  walker.skip(3 * 16 * (1 + 1 + (3 + 4 * 3) * kDouble + 4 + 1));
}

void walk(WireWalker& walker, const grasp_state_t*) {
  walk_hand_header(walker);
  walker.skip(1 + kDouble + 8 + 18 * kDouble);
  walker.skip(3 * (1 + kDouble) + 2 + kDouble + 2 * kDouble);
}

void walk(WireWalker& walker, const object_state_t*) {
  walker.skip(8 + 8);
  walker.string();
  walker.skip(4 + (3 + 4 + 3 + 3 + 36 + 3) * kDouble + 1 + 4 + 8);
}

void walk(WireWalker& walker, const health_t*) {
  walker.skip(8);
  walker.string();
  walker.skip(6 * 8 + 5 * kDouble);
  for (std::int32_t n = walker.count(5 + 2 * 8 + 5 * kDouble); n > 0 && walker.ok(); --n) {
    walker.string();
    walker.skip(2 * 8 + 5 * kDouble);
  }
  for (std::int32_t n = walker.count(5 + 2 * 4 + 3 * 8); n > 0 && walker.ok(); --n) {
    walker.string();
    walker.skip(2 * 4 + 3 * 8);
  }
}

void walk(WireWalker& walker, const kinect::frame_msg_t*) {
  walker.skip(8);
  walker.skip(8 + 2 + 2);  // fixed fields of the colour image
  walker.byte_array();
  walker.skip(1);
  walker.skip(8 + 2 + 2);  // fixed fields of the depth image
  walker.byte_array();
  walker.skip(1 + 1 + 4);
  walker.skip(3 * 2 + 1 + 3 * kDouble + kDouble + 1 + 1);
}

void walk(WireWalker& walker, const bot_core::images_t*) {
  walker.skip(8);
  const std::int32_t n = walker.count(2);
  walker.skip(2 * n);
  for (std::int32_t i = 0; i < n && walker.ok(); ++i) walk_image(walker);
}

}  // namespace barehand
