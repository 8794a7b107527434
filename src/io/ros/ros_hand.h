#pragma once

#include <optional>
#include <string>

#include "barehand/contact_state_t.hpp"
#include "barehand/glove_state_t.hpp"
#include "barehand/grasp_state_t.hpp"
#include "barehand/hand_joints_t.hpp"
#include "barehand/hand_state_t.hpp"
#include "barehand/health_t.hpp"
#include "barehand/object_state_t.hpp"
#include "io/ros/ros_types.h"

namespace barehand::ros {

// Converts the LCM messages of one hand to ROS messages.

/// The LCM messages of one hand in one frame.
struct HandState {
  hand_state_t state;
  glove_state_t glove;
  hand_joints_t joints;
  std::optional<contact_state_t> contact = {};  ///< none: not known
  std::optional<grasp_state_t> grasp = {};      ///< none: not known
};

/// "right" or "left": the first part of the names of a hand's joints and frames, "right_palm".
std::string side_of(const hand_state_t& state);

// joint_state() and add_transforms() must be called only for hands with a pose: a hand without one is left out instead
// of being published with zeros. Poses are in the camera frame and smoothed; only the ellipsoids of markers() lie at
// the raw positions.

/// The angles [rad] of those joints of glove_state_t that can be observed.
JointState joint_state(const HandState& hand);
/// Adds the transform from every segment's frame to the camera's frame.
void add_transforms(const HandState& hand, TFMessage& message);
/// Adds the transform from an object's frame, "object_ID", to the camera's frame.
void add_transform(const object_state_t& object, TFMessage& message);
/// The hand as spheres at its joints and cylinders between them, coloured by confidence from red to green and
/// translucent if inferred, and ellipsoids of two standard deviations at the proximal ends of the segments. Without a
/// pose, a marker that deletes what was drawn before.
MarkerArray markers(const HandState& hand);
/// A sphere at each place where a segment touches something: orange on an object, blue on a hand, translucent if
/// inferred. A marker before them deletes what was drawn before. `hand.contact` must be known.
MarkerArray contact_markers(const HandState& hand);
/// The status of the hand, its grasp if that is known, and the confidence of each segment.
DiagnosticStatus diagnostic(const HandState& hand);
/// The messages of the hand as they are on the LCM network: HAND_STATE, GLOVE_STATE, HAND_JOINTS and, if they are
/// known, CONTACT_STATE and GRASP_STATE.
std::vector<LcmMessage> lcm_messages(const HandState& hand);
/// The message of an object as it is on the LCM network: OBJECT_STATE.
LcmMessage lcm_message(const object_state_t& object);
/// The counters of the pipeline.
DiagnosticStatus diagnostic(const health_t& health);

}  // namespace barehand::ros
