#pragma once

#include <cassert>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/statistics.h"

namespace barehand {

// The bounded queue between two stages of the pipeline.

/// What happens when an item is pushed into a full queue.
enum class Overflow {
  block,        ///< the producer waits; nothing is dropped (replay)
  drop_oldest,  ///< the oldest item is dropped and counted to make room for the new one (live)
};

/// A bounded queue between two stages, for any number of threads. At every moment pushed = popped + dropped + depth.
template <typename T>
class BoundedQueue {
 public:
  BoundedQueue(std::string name, std::size_t capacity, Overflow overflow)
      : name_(std::move(name)), capacity_(capacity), overflow_(overflow) {
    assert(capacity > 0);
  }

  /// Adds an item. Returns false, and neither keeps nor counts the item, if the queue is closed.
  bool push(T item) {
    std::unique_lock lock(mutex_);
    if (overflow_ == Overflow::block) space_.wait(lock, [&] { return items_.size() < capacity_ || closed_; });
    if (closed_) return false;
    if (items_.size() == capacity_) {
      items_.pop_front();
      ++dropped_;
    }
    items_.push_back(std::move(item));
    ++pushed_;
    item_.notify_one();
    return true;
  }

  /// Waits for an item; returns none if the queue is closed and empty.
  std::optional<T> pop() {
    std::unique_lock lock(mutex_);
    item_.wait(lock, [&] { return !items_.empty() || closed_; });
    return take();
  }

  /// Like pop(), but waits no longer than `patience`; returns none after that.
  std::optional<T> pop_within(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    item_.wait_for(lock, patience, [&] { return !items_.empty() || closed_; });
    return take();
  }

  /// Whether the queue is closed and empty.
  bool drained() const {
    std::unique_lock lock(mutex_);
    return closed_ && items_.empty();
  }

  /// Returns an item if one is waiting.
  std::optional<T> try_pop() {
    std::unique_lock lock(mutex_);
    return take();
  }

  /// Declares that no more items will come: consumers take what is left, and blocked producers give up.
  void close() {
    std::unique_lock lock(mutex_);
    closed_ = true;
    item_.notify_all();
    space_.notify_all();
  }

  /// Name, depth and counts of the queue since the start of the run.
  QueueHealth health() const {
    std::unique_lock lock(mutex_);
    return {name_, capacity_, items_.size(), pushed_, popped_, dropped_, {}};
  }

 private:
  std::optional<T> take() {
    if (items_.empty()) return std::nullopt;
    std::optional<T> item(std::move(items_.front()));
    items_.pop_front();
    ++popped_;
    space_.notify_one();
    return item;
  }

  const std::string name_;
  const std::size_t capacity_;
  const Overflow overflow_;
  mutable std::mutex mutex_;
  std::condition_variable item_, space_;
  std::deque<T> items_;
  bool closed_ = false;
  std::int64_t pushed_ = 0, popped_ = 0, dropped_ = 0;
};

}  // namespace barehand
