#pragma once

#include <mutex>
#include <optional>
#include <utility>

namespace barehand {

/// A mailbox for one value between two threads; a newer value replaces one that was not taken yet.
template <typename T>
class Slot {
 public:
  void put(T value) {
    const std::lock_guard lock(mutex_);
    value_ = std::move(value);
  }
  /// Returns the last value put since the previous call, if any.
  std::optional<T> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(value_, std::nullopt);
  }

 private:
  std::mutex mutex_;
  std::optional<T> value_;
};

}  // namespace barehand
