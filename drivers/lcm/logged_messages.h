#pragma once

#include "drivers/lcm/layouts.h"
#include "io/lcm/message_log.h"

namespace barehand {

/// Calls `visit` with every message of one type in a log, in file order. Damaged messages are left out. Errors: those
/// of MessageLog::read(), and those of `visit`, which returns Result<void>, after which it is not called again.
template <class Message, class Visit>
Result<void> visit_messages(MessageLog& log, Visit visit) {
  for (const LogEntry& entry : log.entries()) {
    if (entry.hash != Message::getHash()) continue;
    const auto bytes = log.read(entry);
    if (!bytes) return tl::unexpected(bytes.error());
    const auto message = decode_message<Message>(*bytes);
    if (!message) continue;
    if (auto visited = visit(*message); !visited) return visited;
  }
  return {};
}

}  // namespace barehand
