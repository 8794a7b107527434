#pragma once

#include <atomic>
#include <string>

#include "core/repeat_filter.h"
#include "drivers/openni2/event_box.h"
#include "drivers/openni2/frames/frame_pool.h"

namespace barehand {

/// The output of a live sensor's thread over all sessions of the sensor: numbered frames, and messages about them
/// without repetitions.
class LiveOutput {
 public:
  /// `source`: name of the source, for messages; `capacity`: largest number of waiting frames.
  LiveOutput(std::string source, std::size_t capacity, const Clock& clock);

  /// A frame with arbitrary content, to be filled.
  std::shared_ptr<RgbdFrame> frame() { return pool_.take(); }
  void put(FramePtr frame) { box_.put(std::move(frame)); }
  /// Sends a message to the user. A problem (`trouble`) of a kind that was reported within the last two seconds is
  /// suppressed and counted.
  void notice(const std::string& kind, const std::string& what, const std::string& remedy = "", bool trouble = true);
  /// Tells the user what the thread waits for: at once, after 3 s, and then after four times as long each, until
  /// end_waiting().
  void await(const std::string& kind, const std::string& what, const std::string& remedy);
  void end_waiting() { waiting_.reset(); }
  /// Reports a frame that arrived but cannot be used.
  void skip(const std::string& what, const std::string& remedy);

  /// Converts the index that the sensor gave to a frame to a frame number; gaps in the indices count as lost frames.
  std::int64_t number(int index);
  /// Call when the sensor restarts its indices.
  void restart_numbers() { last_index_ = -1; }

  /// The box with the frames and messages; any thread may take from it.
  EventBox& box() { return box_; }
  /// Counts of the frames that arrived and of those that were lost on the way.
  QueueHealth transit() const;

 private:
  const std::string source_;
  EventBox box_;
  RepeatFilter filter_, waiting_;
  FramePool pool_;
  int last_index_ = -1;
  std::int64_t last_number_ = -1;
  std::atomic<std::int64_t> read_ = 0, lost_ = 0;
};

}  // namespace barehand
