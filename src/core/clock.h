#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace barehand {

/// Source of the time in microseconds. It is passed in by the owner of a run; stages never ask the operating system
/// for the time.
class Clock {
 public:
  virtual ~Clock() = default;
  /// Monotonic time for durations.
  virtual std::int64_t steady_us() const = 0;
  /// Time since the epoch, comparable to capture times.
  virtual std::int64_t utime() const = 0;
};

/// The operating system's clocks.
class SystemClock : public Clock {
 public:
  std::int64_t steady_us() const override { return count(std::chrono::steady_clock::now().time_since_epoch()); }
  std::int64_t utime() const override { return count(std::chrono::system_clock::now().time_since_epoch()); }

 private:
  template <typename Duration>
  static std::int64_t count(Duration d) {
    return std::chrono::duration_cast<std::chrono::microseconds>(d).count();
  }
};

/// A clock that stands still until it is advanced, for tests and for runs that must not depend on time.
class ManualClock : public Clock {
 public:
  explicit ManualClock(std::int64_t now_us = 0) : now_us_(now_us) {}
  std::int64_t steady_us() const override { return now_us_; }
  std::int64_t utime() const override { return now_us_; }
  void advance(std::int64_t us) { now_us_ += us; }

 private:
  std::atomic<std::int64_t> now_us_;
};

}  // namespace barehand
