// Sends the messages of hands, and of the pipeline's health, to the bus and to logs.
#include "stages/publish/publisher.h"

namespace barehand {

Publisher::Publisher(std::string prefix, std::vector<MessageSink*> sinks)
    : prefix_(std::move(prefix)), sinks_(std::move(sinks)) {}

Result<Publisher> Publisher::create(std::string prefix, std::vector<MessageSink*> sinks) {
  const std::size_t longest = prefix.size() + std::string("CONTACT_STATE").size();
  if (longest > kLongestChannel) return fail("the channel prefix is too long for LCM", prefix, "use at most 50 bytes");
  return Publisher(std::move(prefix), std::move(sinks));
}

template <class Message>
void Publisher::send(const char* channel, const Message& message, Result<void>& result) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  for (MessageSink* sink : sinks_) {
    auto sent = sink->send(prefix_ + channel, bytes, message.utime);
    if (!sent && result) result = std::move(sent);
  }
}

Result<void> Publisher::send_hand(const HandMessages& messages) {
  Result<void> result;
  send("HAND_STATE", messages.state, result);
  send("GLOVE_STATE", messages.glove, result);
  send("HAND_JOINTS", messages.joints, result);
  return result;
}

Result<void> Publisher::send_findings(const HandMessages& messages) {
  Result<void> result;
  if (messages.contact) send("CONTACT_STATE", *messages.contact, result);
  if (messages.grasp) send("GRASP_STATE", *messages.grasp, result);
  return result;
}

Result<void> Publisher::send(const object_state_t& object) {
  Result<void> result;
  send("OBJECT_STATE", object, result);
  return result;
}

Result<void> Publisher::send(const health_t& health) {
  Result<void> result;
  send("HEALTH", health, result);
  return result;
}

}  // namespace barehand
