#pragma once

#include <string>
#include <vector>

#include "barehand/health_t.hpp"
#include "barehand/object_state_t.hpp"
#include "io/lcm/message_sink.h"
#include "stages/publish/hand_messages.h"

namespace barehand {

/// Sends messages to every sink (a bus, a log, or both), on the channels HAND_STATE, GLOVE_STATE, HAND_JOINTS,
/// CONTACT_STATE, GRASP_STATE, OBJECT_STATE and HEALTH with the prefix in front. The sinks must outlive this object.
class Publisher {
 public:
  /// Errors: with this prefix, a channel name would be too long for LCM (63 bytes).
  static Result<Publisher> create(std::string prefix, std::vector<MessageSink*> sinks);

  // Every sink gets the messages even if another fails; the first error is returned.

  /// The hand itself: HAND_STATE, GLOVE_STATE and HAND_JOINTS.
  Result<void> send_hand(const HandMessages& messages);
  /// What was found about it, if anything: CONTACT_STATE and GRASP_STATE.
  Result<void> send_findings(const HandMessages& messages);
  Result<void> send(const object_state_t& object);
  Result<void> send(const health_t& health);

 private:
  Publisher(std::string prefix, std::vector<MessageSink*> sinks);
  template <class Message>
  void send(const char* channel, const Message& message, Result<void>& result);

  std::string prefix_;
  std::vector<MessageSink*> sinks_;
};

}  // namespace barehand
