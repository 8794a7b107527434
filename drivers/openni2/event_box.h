#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

#include "core/statistics.h"
#include "sensor/frame_source.h"

namespace barehand {

/// Passes frames and messages from a sensor's thread to their consumer. The number of waiting frames is bounded, and
/// the newest are kept. Any thread may use it.
class EventBox {
 public:
  explicit EventBox(std::size_t capacity) : capacity_(capacity) {}

  /// Adds a frame; the oldest one is dropped if the box is full.
  void put(FramePtr frame) {
    const std::lock_guard lock(mutex_);
    if (frames_.size() == capacity_) {
      frames_.pop_front();
      ++replaced_;
    }
    frames_.push_back(std::move(frame));
    ++pushed_;
    changed_.notify_one();
  }
  /// Adds a notice or a skipped frame; the oldest one is dropped if kMostTold of them wait.
  void tell(SourceEvent event) {
    const std::lock_guard lock(mutex_);
    if (told_.size() == kMostTold) told_.pop_front();
    told_.push_back(std::move(event));
    changed_.notify_one();
  }
  /// The next event, messages before frames; none if nothing arrives within `patience`.
  std::optional<SourceEvent> take(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [this] { return !told_.empty() || !frames_.empty(); });
    if (!told_.empty()) return taken(told_);
    if (!frames_.empty()) return taken(frames_);
    return std::nullopt;
  }
  /// Counts of the frames that were added, taken and dropped.
  QueueHealth health() const {
    const std::lock_guard lock(mutex_);
    const auto waiting = static_cast<std::int64_t>(frames_.size());
    return {"inbox", capacity_, frames_.size(), pushed_, pushed_ - replaced_ - waiting, replaced_, {}};
  }

 private:
  static constexpr std::size_t kMostTold = 64;
  template <class T>
  static SourceEvent taken(std::deque<T>& queue) {
    SourceEvent event(std::move(queue.front()));
    queue.pop_front();
    return event;
  }

  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<FramePtr> frames_;
  std::deque<SourceEvent> told_;
  std::int64_t pushed_ = 0, replaced_ = 0;
};

}  // namespace barehand
