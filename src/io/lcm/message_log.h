#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/lcm/lcm_log_reader.h"
#include "io/mcap/mcap_reader.h"

namespace barehand {

/// Random access to the LCM messages of a log of either format: an LCM log, or an MCAP file in which `track --mcap` has
/// put the messages of the hands (ros::LcmMessage). The content of the file tells which.
class MessageLog {
 public:
  /// Finds every message. There may be none. Errors: the file cannot be opened, or is empty.
  static Result<MessageLog> open(const std::string& path);

  const std::vector<LogEntry>& entries() const { return lcm_ ? lcm_->entries() : entries_; }  ///< in file order
  /// Sentences that say what was left out because it is damaged or cut off.
  const std::vector<std::string>& warnings() const { return warnings_; }
  bool is_mcap() const { return mcap_.has_value(); }

  /// Reads the message of an entry. This fails only if the file changes or the disk breaks.
  Result<std::vector<std::uint8_t>> read(const LogEntry& entry);

 private:
  Result<void> open_mcap(const std::string& path);

  std::optional<LcmLogReader> lcm_;
  std::optional<mcap::McapReader> mcap_;
  std::vector<LogEntry> entries_;  // entries of an MCAP file; LogEntry::position is the index into `messages_`
  std::vector<mcap::Message> messages_;
  std::vector<std::string> warnings_;
};

}  // namespace barehand
