#pragma once

#include <cstdint>
#include <future>
#include <limits>
#include <optional>
#include <utility>

#include "core/parallel/is_ready.h"

namespace barehand {

/// The result of Workers::run_in_background() for one frame, which is used some frames later: in a recording always
/// equally many, so that results are the same on every machine. Not thread-safe.
template <typename T>
class DelayedResult {
 public:
  /// Begins to wait for a result in frame number `now`. None may be pending.
  void begin(std::int64_t now, std::future<T> result) {
    begun_ = now;
    result_ = std::move(result);
  }
  bool pending() const { return result_.valid(); }
  /// Lets a pending result be dropped.
  void outdate() { begun_ = std::numeric_limits<std::int64_t>::min() / 2; }
  /// The result, once, if it is there in frame number `now` and neither too new nor outdated. Exceptions of the work
  /// are rethrown.
  std::optional<T> take(std::int64_t now) {
    const std::int64_t age = now - begun_;
    if (age < kDelay || !is_ready(result_)) return std::nullopt;
    T result = result_.get();
    if (age > kOutdated) return std::nullopt;
    return result;
  }

 private:
  static constexpr std::int64_t kDelay = 2;     // frames after which a result is used, since most take about as long
  static constexpr std::int64_t kOutdated = 8;  // frames after which it is dropped, since the hand has moved
  std::int64_t begun_ = 0;
  std::future<T> result_;
};

}  // namespace barehand
