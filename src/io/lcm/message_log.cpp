#include "io/lcm/message_log.h"

#include "io/ros/cdr.h"

namespace barehand {

Result<MessageLog> MessageLog::open(const std::string& path) {
  // MCAP files are recognised by their content.
  MessageLog log;
  if (mcap::is_mcap(path)) {
    if (const auto opened = log.open_mcap(path); !opened) return tl::unexpected(opened.error());
    return log;
  }

  // Everything else must be an LCM log.
  auto lcm = LcmLogReader::open(path);
  if (!lcm) return tl::unexpected(lcm.error());
  if (const std::int64_t damaged = lcm->damaged_bytes(); damaged > 0)
    log.warnings_.push_back(path + ": " + std::to_string(damaged) +
                            " bytes are damaged or cut off; every complete event is used");
  log.lcm_ = std::move(*lcm);
  return log;
}

Result<void> MessageLog::open_mcap(const std::string& path) {
  // List the LCM messages; the others are not for this log.
  const std::string type = ros::schema_name<ros::LcmMessage>();
  const auto visit = [&](const mcap::Message& message, const mcap::Channel& channel, auto bytes) {
    if (channel.type != type || channel.encoding != "cdr") return;
    const auto lcm = ros::decode<ros::LcmMessage>(bytes);
    if (!lcm) return;

    LogEntry entry;
    entry.position = static_cast<std::int64_t>(messages_.size());
    entry.timestamp = static_cast<std::int64_t>(message.log_time / 1000);
    entry.channel = lcm->channel;
    entry.size = static_cast<std::int32_t>(lcm->data.size());
    entry.read_start(lcm->data);
    entries_.push_back(std::move(entry));
    messages_.push_back(message);
  };

  // Read the file once.
  auto reader = mcap::McapReader::open(path, visit);
  if (!reader) return tl::unexpected(reader.error());
  warnings_ = reader->warnings();
  mcap_ = std::move(*reader);
  return {};
}

Result<std::vector<std::uint8_t>> MessageLog::read(const LogEntry& entry) {
  if (lcm_) return lcm_->read(entry);
  const auto bytes = mcap_->read(messages_[static_cast<std::size_t>(entry.position)]);
  if (!bytes) return tl::unexpected(bytes.error());
  return ros::decode<ros::LcmMessage>(*bytes).map([](ros::LcmMessage&& message) { return std::move(message.data); });
}

}  // namespace barehand
