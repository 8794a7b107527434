#include "core/repeat_filter.h"

namespace barehand {

std::optional<std::int64_t> RepeatFilter::admit(const std::string& kind) {
  const std::int64_t now = clock_.steady_us();
  std::unique_lock lock(mutex_);
  const auto [it, first] = entries_.try_emplace(kind, Entry{now, 0});
  Entry& entry = it->second;
  if (!first && now - entry.last_us < interval_us_) {
    ++entry.kept_back;
    return std::nullopt;
  }
  entry.last_us = now;
  return std::exchange(entry.kept_back, 0);
}

}  // namespace barehand
