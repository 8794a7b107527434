#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>

#include "core/memory/frame_memory.h"
#include "hand/segments.h"
#include "math/se3.h"

namespace barehand {

// What the hands of one frame touch.

/// Whether a segment touches something. unknown: what would tell is not in view; an unseen side of an object is
/// unknown, never empty. none: nothing is near; near: within ContactParams::near_distance; touching: more likely than
/// not.
enum class ContactState : std::int8_t { unknown = 0, none = 1, near = 2, touching = 3 };

/// The nearest surface to the skin of one segment. Camera frame, metres. Numbers are NaN where they are not known.
struct Contact {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  ContactState state = ContactState::unknown;
  /// The segment is not seen in this frame; the contact is inferred.
  bool inferred = false;
  double probability = kUnknown;  ///< probability that the distance is below ContactParams::touch_distance
  double distance = kUnknown;     ///< distance from the segment's skin to the surface; negative inside
  double deviation = kUnknown;    ///< standard deviation of the distance
  Eigen::Vector3d point = Eigen::Vector3d::Constant(kUnknown);  ///< point on the surface that is nearest to the segment
  Eigen::Vector3d normal = Eigen::Vector3d::Constant(kUnknown);  ///< outward normal of the surface at this point
  std::int32_t partner = -1;  ///< ObjectEstimate::id, or HandEstimate::hand_id of the other hand; -1: none
  std::int8_t segment = -1;   ///< the nearest segment of a hand; -1: the surface does not belong to a hand
};
using SegmentContacts = std::array<Contact, kSegmentCount>;

/// What the segments of one hand touch: objects, other segments of the same hand, the other hand.
struct HandContacts {
  SegmentContacts object, own, other_hand;
};

/// Unknown objects have ids from here on. Those of known objects are their places among the options: 1, 2 and so on.
inline constexpr std::int32_t kFirstUnknownObject = 1001;

/// An object in or near a hand. Camera frame, metres.
struct ObjectEstimate {
  std::int32_t id = 0;  ///< stays with one object for as long as it is seen
  SE3 T_camera_object;
  Vector6d velocity = Vector6d::Constant(Contact::kUnknown);  ///< velocity of its origin [m/s, rad/s]; NaN: not known
  Matrix6d covariance = Matrix6d::Identity();        ///< covariance of the boxplus twist (translation, rotation)
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();  ///< size of its known surface along its own axes [m]
  bool held = false;                                 ///< it moves with a palm
  std::int32_t hand_id = -1;                         ///< the hand that holds it; -1: none
  /// Time of the frame in which `held` changed last, or the object appeared [us since the epoch].
  std::int64_t since = 0;
};

/// What the hands of one frame touch. Immutable once shared.
struct FrameContacts {
  FrameVector<HandContacts> hands;      ///< in the order of the frame's estimates
  FrameVector<ObjectEstimate> objects;  ///< in the order of their ids
};
using FrameContactsPtr = std::shared_ptr<const FrameContacts>;

}  // namespace barehand
