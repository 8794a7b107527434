#pragma once

#include <algorithm>
#include <chrono>

namespace barehand {

/// The time to wait before the next attempt to open a sensor. It doubles with every attempt up to a limit, so that the
/// return of a sensor is noticed within two seconds.
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
