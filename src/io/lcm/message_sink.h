#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/error.h"

namespace barehand {

/// Longest channel name that LCM accepts, on a bus and in a log [bytes].
inline constexpr std::size_t kLongestChannel = 63;

/// A destination of encoded LCM messages: a bus or a log file.
class MessageSink {
 public:
  virtual ~MessageSink() = default;
  /// Sends a message. `utime`: time of the measurement [us], which a log stores as the event's time stamp instead of
  /// the wall-clock time.
  virtual Result<void> send(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t utime) = 0;
  /// Call it after the last message. On return, everything that was sent has reached its destination.
  virtual Result<void> finish() { return {}; }
};

}  // namespace barehand
