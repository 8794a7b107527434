#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/clock.h"

namespace barehand {

/// Prevents a repeated message from flooding the log: the first message of a kind passes, then at most one per
/// interval, which reports how many were suppressed. For any number of threads.
class RepeatFilter {
 public:
  RepeatFilter(const Clock& clock, std::int64_t interval_us) : clock_(clock), interval_us_(interval_us) {}

  /// Returns the number of messages of this kind suppressed since the last one that passed, or none if this one should
  /// be suppressed, too. Kinds must be few and fixed, such as the name of a stage, not messages with frame numbers.
  std::optional<std::int64_t> admit(const std::string& kind);

 private:
  struct Entry {
    std::int64_t last_us = 0;
    std::int64_t kept_back = 0;
  };
  const Clock& clock_;
  const std::int64_t interval_us_;
  std::mutex mutex_;
  std::map<std::string, Entry> entries_;
};

}  // namespace barehand
