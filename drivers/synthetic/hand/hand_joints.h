#pragma once

#include <optional>
#include <string_view>

#include "hand/segments.h"

namespace barehand::synthetic {

/// The number of joints of a rigged hand. They are those of WebXR and OpenXR, in this order: wrist, thumb {metacarpal,
/// proximal, distal, tip}, then index, middle, ring, little {metacarpal, proximal, intermediate, distal, tip}. OpenXR's
/// palm joint is left out, since it is a point and not a bone.
inline constexpr int kJointCount = 25;
inline constexpr int kWristJoint = 0;

/// Index of joint k of a finger (0 = thumb), where k = 0 is the metacarpal and the last k is the tip (3 for the thumb,
/// 4 for the others).
constexpr int joint_of(int finger, int k) { return finger == 0 ? 1 + k : 5 * finger + k; }

/// The rigid segment that moves with a joint: the wrist and the metacarpals 2 to 5 form the palm; a tip belongs to the
/// last phalanx.
constexpr int segment_of_joint(int joint) {
  if (joint == kWristJoint) return kPalm;
  if (joint < 5) return segment_of(0, joint < 4 ? joint - 1 : 2);
  const int finger = joint / 5, k = joint % 5;
  if (k == 0) return kPalm;
  return segment_of(finger, k < 4 ? k - 1 : 2);
}
/// The joint in whose frame a segment moves; the wrist for the palm.
constexpr int joint_of_segment(int segment) {
  if (segment == kPalm) return kWristJoint;
  const int finger = finger_of(segment), k = (segment - 1) % 3;
  return joint_of(finger, finger == 0 ? k : k + 1);
}
/// The next joint towards the wrist; -1 for the wrist itself.
constexpr int parent_of_joint(int joint) {
  if (joint == kWristJoint) return -1;
  return joint == 1 || (joint >= 5 && joint % 5 == 0) ? kWristJoint : joint - 1;
}

/// The joint with this name; none if there is no such joint. Recognises "index-finger-phalanx-proximal" (WebXR),
/// "XR_HAND_JOINT_INDEX_PROXIMAL_EXT" (OpenXR), "index_proximal", "pinky" for little, and a side as prefix or suffix
/// ("left_", "_r").
std::optional<int> joint_from_name(std::string_view name);
/// The name of a joint for messages, such as "index_proximal".
std::string_view joint_name(int joint);

}  // namespace barehand::synthetic
