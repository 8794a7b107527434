#pragma once

#include <map>
#include <memory>
#include <string>

#include "drivers/lcm/logged_messages.h"
#include "hand/contacts.h"
#include "hand/hand_pose.h"

namespace barehand {

/// The estimate that a message states, as far as the recognition of grasps needs it, with a profile that has the
/// lengths of the hand.
inline HandEstimate estimate_of(const hand_state_t& state) {
  const auto profile = std::make_shared<HandProfile>();
  HandEstimate estimate;
  estimate.utime = state.utime;
  estimate.number = state.frame_number;
  estimate.sensor = state.sensor;
  estimate.status = static_cast<TrackStatus>(state.status);
  estimate.hand_id = state.hand_id;
  estimate.handedness = state.handedness == hand_state_t::LEFT ? Handedness::left : Handedness::right;
  for (int s = 0; s < kSegmentCount; ++s) {
    const segment_state_t& stated = state.segments[s];
    SegmentState& segment = estimate.segments[s];
    const double(&q)[4] = stated.orientation;
    segment.T_camera_segment = {Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix(),
                                Eigen::Vector3d(stated.position)};
    segment.covariance = Eigen::Map<const Matrix6d>(stated.covariance[0]);  // symmetric, so either order is right
    profile->segments[s].distal = segment.T_camera_segment.inverse() * Eigen::Vector3d(stated.distal);
  }
  estimate.profile = profile;
  return estimate;
}

/// Contacts with objects that a log of hand states holds, by hand and utime.
using LoggedContacts = std::map<std::pair<std::int32_t, std::int64_t>, SegmentContacts>;

/// Reads which segments touch objects, from all messages of a log.
inline Result<LoggedContacts> read_contacts(MessageLog& log) {
  LoggedContacts contacts;
  const auto read = visit_messages<contact_state_t>(log, [&](const contact_state_t& message) -> Result<void> {
    SegmentContacts& segments = contacts[{message.hand_id, message.utime}];
    for (int s = 0; s < kSegmentCount; ++s) segments[s].state = static_cast<ContactState>(message.object[s].state);
    return {};
  });
  if (!read) return tl::unexpected(read.error());
  return contacts;
}

/// A hand in a log, and what it touches.
struct LoggedHand {
  hand_state_t state;
  HandEstimate estimate;
  FrameContactsPtr contacts;  ///< only states are set; null: the log does not tell
};

/// Calls `visit` for each state of a hand in a log, in the order of the log.
template <class Visit>
Result<void> visit_hands(const std::string& path, Visit visit) {
  auto log = MessageLog::open(path);
  if (!log) return tl::unexpected(log.error());
  const auto contacts = read_contacts(*log);
  if (!contacts) return tl::unexpected(contacts.error());
  return visit_messages<hand_state_t>(*log, [&](const hand_state_t& state) -> Result<void> {
    LoggedHand hand{state, estimate_of(state), nullptr};

    // Find what it touches.
    if (const auto found = contacts->find({state.hand_id, state.utime}); found != contacts->end()) {
      const auto frame = std::make_shared<FrameContacts>();
      frame->hands.resize(1);
      frame->hands[0].object = found->second;
      hand.contacts = frame;
    }
    return visit(hand);
  });
}

}  // namespace barehand
