#pragma once

#include <cstdint>
#include <optional>

namespace barehand {

/// Where a replay of a recording is: the frames are played from a first one on, forward or backwards, until a step
/// leads out of the recording.
class ReplayPosition {
 public:
  /// Nothing is left to play.
  ReplayPosition() = default;
  /// `start`: first frame, counted from 0; none: the first one or, backwards, the last one. `step`: every step-th
  /// frame; negative plays backwards; must not be 0. `count`: number of frames of the recording.
  ReplayPosition(std::optional<std::int64_t> start, std::int64_t step, std::int64_t count)
      : next_(start.value_or(step > 0 ? 0 : count - 1)), step_(step), count_(count) {}

  /// The frame to be played next; it may lie outside the recording.
  std::int64_t next() const { return next_; }
  bool at_end() const { return next_ < 0 || next_ >= count_; }
  /// Number of frames that are left to play.
  std::int64_t remaining() const {
    if (at_end()) return 0;
    return step_ > 0 ? (count_ - 1 - next_) / step_ + 1 : next_ / -step_ + 1;
  }
  /// Returns the frame to be played next, and moves on. None: the replay is over.
  std::optional<std::int64_t> take() {
    if (at_end()) return std::nullopt;
    const std::int64_t taken = next_;
    next_ += step_;
    return taken;
  }

 private:
  std::int64_t next_ = 0, step_ = 1, count_ = 0;
};

}  // namespace barehand
