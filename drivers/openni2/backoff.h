#pragma once

#include <algorithm>
#include <chrono>

namespace barehand {

/// The waiting time before the next attempt. It doubles each time up to a limit, so that a sensor's return is noticed
/// within two seconds.
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
