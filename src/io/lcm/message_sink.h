#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/error.h"

namespace barehand {

/// Longest channel name that LCM takes, on a bus and in a log [bytes].
inline constexpr std::size_t kLongestChannel = 63;

/// Where encoded LCM messages go: a bus, a log file.
class MessageSink {
 public:
  virtual ~MessageSink() = default;
  /// `utime`: time of the measurement [us]; sinks that stamp events use it, never the wall clock.
  virtual Result<void> send(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t utime) = 0;
  /// After the last message: what was sent is where it belongs when this returns.
  virtual Result<void> finish() { return {}; }
};

}  // namespace barehand
