#pragma once

#include <string>

#include "barehand/glove_state_t.hpp"
#include "barehand/hand_joints_t.hpp"
#include "barehand/hand_state_t.hpp"
#include "barehand/health_t.hpp"
#include "io/ros/ros_types.h"

namespace barehand::ros {

/// What is published of one hand in one frame.
struct HandState {
  hand_state_t state;
  glove_state_t glove;
  hand_joints_t joints;
};

/// "right" or "left": the first part of the names of a hand's joints and frames, "right_palm".
std::string side_of(const hand_state_t& state);

// A hand that is not seen is withheld, never zero: joint_state and transforms are for hands with a pose. All poses are
// the smoothed ones, in the frame of the camera.

/// The joints of glove_state_t [rad], those that can be observed.
JointState joint_state(const HandState& hand);
/// From every segment's frame to the camera's.
void add_transforms(const HandState& hand, TFMessage& message);
/// The hand as spheres at its joints and cylinders between them, coloured by confidence from red to green and
/// translucent where it is inferred, and ellipsoids of two standard deviations. Without a pose: a hand that was drawn
/// before goes.
MarkerArray markers(const HandState& hand);
/// Whether the hand is tracked, and how sure each segment is.
DiagnosticStatus diagnostic(const HandState& hand);
/// The counters of the pipeline.
DiagnosticStatus diagnostic(const health_t& health);

}  // namespace barehand::ros
