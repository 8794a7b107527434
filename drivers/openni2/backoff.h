#pragma once

#include <algorithm>
#include <chrono>

namespace barehand {

/// How long to wait before the next attempt: twice as long each time, up to a limit that keeps the time to notice a
/// sensor's return below two seconds.
class Backoff {
 public:
  std::chrono::milliseconds next() {
    const auto now = wait_;
    wait_ = std::min(2 * wait_, kLongest);
    return now;
  }
  void reset() { wait_ = kShortest; }

  static constexpr std::chrono::milliseconds kShortest{100}, kLongest{1600};

 private:
  std::chrono::milliseconds wait_ = kShortest;
};

}  // namespace barehand
