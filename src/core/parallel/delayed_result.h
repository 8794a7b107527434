#pragma once

#include <chrono>
#include <cstdint>
#include <future>
#include <optional>
#include <utility>

namespace barehand {

/// The result of Workers::run_in_background() for one frame, which is used some frames later: in a recording always
/// equally many, so that results are the same on every machine. Not thread-safe.
template <typename T>
class DelayedResult {
 public:
  /// `delay`: number of frames after which a result is used, at least 1. `outdated`: number of frames after which it is
  /// dropped instead.
  DelayedResult(int delay, int outdated) : delay_(delay), outdated_(outdated) {}

  /// Begins to wait for a result in frame number `now`. None may be pending.
  void begin(std::int64_t now, std::future<T> result) {
    begun_ = now;
    result_ = std::move(result);
  }
  bool pending() const { return result_.valid(); }
  /// The result, once, if it is there and old enough in frame number `now`. Exceptions of the work are rethrown.
  std::optional<T> take(std::int64_t now) {
    if (!pending() || now - begun_ < delay_ || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
      return std::nullopt;
    T result = result_.get();
    if (now - begun_ > outdated_) return std::nullopt;
    return result;
  }

 private:
  int delay_, outdated_;
  std::int64_t begun_ = 0;
  std::future<T> result_;
};

}  // namespace barehand
