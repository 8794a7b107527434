#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/clock.h"

namespace barehand {

/// Keeps a repeated message from flooding the log: the first of a kind passes, then one per interval, and it says how
/// many were kept back. Any thread.
class RepeatFilter {
 public:
  RepeatFilter(const Clock& clock, std::int64_t interval_us) : clock_(clock), interval_us_(interval_us) {}

  /// Number of messages of this kind kept back since the last that passed; none: keep this one back, too. Kinds are few
  /// and fixed (a stage's name, not a message with a frame number in it).
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
