// Reads stated contacts from a log of hand states.
#include "app/eval/stated_contacts.h"

#include <optional>

#include "barehand/contact_state_t.hpp"
#include "drivers/lcm/logged_messages.h"

namespace barehand {

Result<StatedContacts> read_stated_contacts(const std::string& log_path) {
  auto log = MessageLog::open(log_path);
  if (!log) return tl::unexpected(log.error());
  StatedContacts contacts;
  std::optional<std::int8_t> side;

  // Read every message that states contacts.
  const auto read = visit_messages<contact_state_t>(*log, [&](const contact_state_t& state) -> Result<void> {
    // A truth is that of one hand.
    if (state.handedness != side.value_or(state.handedness))
      return fail("holds the contacts of two hands, and a truth is one hand's", log_path,
                  "track the hand alone: --hand right or --hand left");
    side = state.handedness;

    auto& segments = contacts[state.utime];
    for (int s = 0; s < kSegmentCount; ++s) {
      const segment_contact_t& stated = state.object[s];
      const bool known = stated.state != contact_state_t::UNKNOWN && stated.probability >= 0 && stated.probability <= 1;
      segments[s] = {known, known && stated.state == contact_state_t::TOUCHING, stated.probability,
                     Eigen::Vector3d(stated.point)};
    }
    return {};
  });
  if (!read) return tl::unexpected(read.error());

  // Refuse a log without contacts.
  if (contacts.empty())
    return fail("holds no contacts", log_path,
                "give a log written by barehand track --states-log or --mcap with contact.enabled: true");
  return contacts;
}

}  // namespace barehand
