#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/clock.h"

namespace barehand {

/// For messages that say what a program waits for, which may last for days: they come 3 s after the first one, then
/// after four times as long each.
inline constexpr std::int64_t kWaitingIntervalUs = 3'000'000;
inline constexpr int kWaitingGrowth = 4;

/// Prevents a repeated message from flooding the log: the first message of a kind passes, then at most one per
/// interval, which reports how many were suppressed. For any number of threads.
class RepeatFilter {
 public:
  /// After each message of a kind that passes, the interval until the next one is `growth` times as long.
  RepeatFilter(const Clock& clock, std::int64_t interval_us, int growth = 1)
      : clock_(clock), interval_us_(interval_us), growth_(growth) {}

  /// Returns the number of messages of this kind suppressed since the last one that passed, or none if this one should
  /// be suppressed, too. Kinds must be few and fixed, such as the name of a stage, not messages with frame numbers.
  std::optional<std::int64_t> admit(const std::string& kind);
  /// Forgets all messages: the next one of each kind passes, and the intervals begin anew.
  void reset();

 private:
  struct Entry {
    std::int64_t last_us = 0;
    std::int64_t interval_us = 0;
    std::int64_t kept_back = 0;
  };
  const Clock& clock_;
  const std::int64_t interval_us_;
  const int growth_;
  std::mutex mutex_;
  std::map<std::string, Entry> entries_;
};

}  // namespace barehand
