#include "stages/publish/contact_messages.h"

#include <algorithm>

#include "barehand/hand_state_t.hpp"
#include "stages/publish/message_fields.h"

namespace barehand {
namespace {

const ObjectEstimate* find_object(const FrameVector<ObjectEstimate>& objects, std::int32_t id) {
  const auto found = std::find_if(objects.begin(), objects.end(), [&](const ObjectEstimate& o) { return o.id == id; });
  return found == objects.end() ? nullptr : &*found;
}

segment_contact_t segment_message(const Contact& contact, const ObjectEstimate* object) {
  segment_contact_t out{};
  out.state = static_cast<std::int8_t>(contact.state);
  out.inferred = contact.inferred;
  out.probability = contact.probability;
  out.distance = contact.distance;
  out.deviation = contact.deviation;
  copy(contact.point, out.point);
  copy(contact.normal, out.normal);

  // State the place and the normal in the frame of the object, too, if there is one.
  const SE3 unknown{Eigen::Matrix3d::Constant(Contact::kUnknown), Eigen::Vector3d::Constant(Contact::kUnknown)};
  const SE3 T_object_camera = object ? object->T_camera_object.inverse() : unknown;
  copy(T_object_camera * contact.point, out.point_in_object);
  copy(T_object_camera.R * contact.normal, out.normal_in_object);

  out.partner = contact.partner;
  out.segment = contact.segment;
  return out;
}

template <class Message>
void fill_frame(Message& out, const HandEstimate& estimate) {
  out.utime = estimate.utime;
  out.frame_number = estimate.number;
  out.sensor = estimate.sensor;
}

}  // namespace

contact_state_t contact_message(const HandEstimate& estimate, TrackStatus published, const HandContacts& contacts,
                                const FrameVector<ObjectEstimate>& objects) {
  contact_state_t out{};
  fill_frame(out, estimate);
  out.hand_id = estimate.hand_id;
  out.handedness = estimate.handedness == Handedness::left ? hand_state_t::LEFT : hand_state_t::RIGHT;
  out.status = static_cast<std::int8_t>(published);
  for (int s = 0; s < kSegmentCount; ++s) {
    out.object[s] = segment_message(contacts.object[s], find_object(objects, contacts.object[s].partner));
    out.own[s] = segment_message(contacts.own[s], nullptr);
    out.other_hand[s] = segment_message(contacts.other_hand[s], nullptr);
  }
  return out;
}

object_state_t object_message(const HandEstimate& estimate, const ObjectEstimate& object) {
  object_state_t out{};
  fill_frame(out, estimate);
  out.object_id = object.id;

  // State the pose, the motion and the uncertainty.
  copy(object.T_camera_object.t, out.position);
  copy(object.T_camera_object.R, out.orientation);
  copy(object.velocity.head<3>(), out.linear_velocity);
  copy(object.velocity.tail<3>(), out.angular_velocity);
  copy(object.covariance, out.covariance);
  copy(object.extent, out.extent);

  // State which hand holds it.
  out.held = object.held;
  out.hand_id = object.hand_id;
  out.since = object.since;
  return out;
}

}  // namespace barehand
