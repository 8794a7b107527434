#include "core/repeat_filter.h"

namespace barehand {

std::optional<std::int64_t> RepeatFilter::admit(const std::string& kind) {
  const std::int64_t now = clock_.steady_us();
  std::unique_lock lock(mutex_);
  const auto [it, first] = entries_.try_emplace(kind, Entry{now, interval_us_, 0});
  Entry& entry = it->second;
  if (!first && now - entry.last_us < entry.interval_us) {
    ++entry.kept_back;
    return std::nullopt;
  }
  if (!first) entry.interval_us *= growth_;
  entry.last_us = now;
  return std::exchange(entry.kept_back, 0);
}

void RepeatFilter::reset() {
  const std::lock_guard lock(mutex_);
  entries_.clear();
}

}  // namespace barehand
