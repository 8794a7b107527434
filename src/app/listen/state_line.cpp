// Describes messages of a tracker for `barehand listen`.
#include "app/listen/state_line.h"

#include "core/format.h"
#include "drivers/lcm/layouts.h"
#include "hand/grasps/grasp_types.h"
#include "hand/segments.h"
#include "hand/status_name.h"
#include "math/angles.h"

namespace barehand {
namespace {

const char* status_text(int status) {
  return status >= 0 && status < 4 ? to_string(static_cast<TrackStatus>(status)).data() : "?";
}

/// The beginning of a line: the frame and the hand of a message.
template <class Message>
std::string hand_of(const Message& m) {
  return formatted("frame %lld  %s hand %d", static_cast<long long>(m.frame_number),
                   m.handedness == hand_state_t::LEFT ? "left" : "right", m.hand_id);
}

/// Status and, if there is a pose, the palm's position [m] and confidence.
std::string line_of(const hand_state_t& m) {
  const std::string hand = hand_of(m) + formatted("  %-9s", status_text(m.status));
  if (!m.has_pose) return hand;
  const segment_state_t& palm = m.segments[0];
  return hand + formatted("  palm %7.3f %7.3f %7.3f m  confidence %.2f", palm.position[0], palm.position[1],
                          palm.position[2], palm.confidence);
}

std::string line_of(const glove_state_t& m) {
  std::string line = hand_of(m) + "  flexion of knuckles [deg]";
  for (const int channel : {glove_state_t::THUMB_MPJ, glove_state_t::INDEX_MPJ, glove_state_t::MIDDLE_MPJ,
                            glove_state_t::RING_MPJ, glove_state_t::PINKIE_MPJ})
    line += formatted(" %5.0f", m.channel[channel] / kDegree);
  return line;
}

/// The segments that touch; "" if none of them does.
std::string touches(const char* what, const segment_contact_t (&contacts)[kSegmentCount]) {
  std::string names;
  for (int s = 0; s < kSegmentCount; ++s)
    if (contacts[s].state == contact_state_t::TOUCHING)
      names.append(names.empty() ? "" : ", ").append(kSegmentNames[static_cast<std::size_t>(s)]);
  return names.empty() ? "" : std::string("  ").append(what).append(": ").append(names);
}

std::string line_of(const contact_state_t& m) {
  const std::string all =
      touches("an object", m.object) + touches("itself", m.own) + touches("the other hand", m.other_hand);
  return hand_of(m) + "  touches" + (all.empty() ? "  nothing that is known" : all);
}

std::string line_of(const grasp_state_t& m) {
  const std::string grasp = hand_of(m) + "  grasp " + std::string(grasp_name(m.grasp));
  if (m.grasp == grasp_state_t::UNKNOWN) return grasp;
  return grasp + formatted("  probability %.2f  opening %.0f mm", m.probability, 1e3 * m.aperture);
}

std::string line_of(const object_state_t& m) {
  const std::string holder = m.held ? formatted("held by hand %d", m.hand_id) : "not held";
  return formatted("frame %lld  object %d  at %7.3f %7.3f %7.3f m  ", static_cast<long long>(m.frame_number),
                   m.object_id, m.position[0], m.position[1], m.position[2]) +
         holder;
}

/// The line of a message if it is of this type; "" if it is not, or is damaged.
template <class Message>
std::string line_as(WireBytes bytes) {
  const auto message = decode_message<Message>(bytes);
  return message ? line_of(*message) : "";
}

}  // namespace

std::string state_line(const std::string& channel, WireBytes message) {
  for (const auto line : {line_as<hand_state_t>, line_as<glove_state_t>, line_as<contact_state_t>,
                          line_as<grasp_state_t>, line_as<object_state_t>})
    if (std::string text = line(message); !text.empty()) return text;
  return formatted("%s: %zu bytes of another type, or damaged", channel.c_str(), message.size());
}

}  // namespace barehand
