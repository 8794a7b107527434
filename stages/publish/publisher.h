#pragma once

#include <string>
#include <vector>

#include "barehand/health_t.hpp"
#include "io/lcm/message_sink.h"
#include "stages/publish/hand_messages.h"

namespace barehand {

/// Sends messages on `<prefix>`HAND_STATE, GLOVE_STATE, HAND_JOINTS and HEALTH to every sink it was given (a bus, a
/// log, both). Sinks outlive it.
class Publisher {
 public:
  /// A prefix that makes a channel name longer than 63 bytes is an error.
  static Result<Publisher> create(std::string prefix, std::vector<MessageSink*> sinks);

  /// Every sink gets the messages even if another fails; the first error is returned.
  Result<void> send(const HandMessages& messages);
  Result<void> send(const health_t& health);

 private:
  Publisher(std::string prefix, std::vector<MessageSink*> sinks);
  template <class Message>
  void send(const char* channel, const Message& message, Result<void>& result);

  std::string prefix_;
  std::vector<MessageSink*> sinks_;
};

}  // namespace barehand
