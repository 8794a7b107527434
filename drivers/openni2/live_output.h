#pragma once

#include <atomic>
#include <string>

#include "core/repeat_filter.h"
#include "drivers/openni2/event_box.h"
#include "drivers/openni2/frame_pool.h"

namespace barehand {

/// What a live sensor's thread hands out, whichever time the sensor is open: numbered frames, and what is to be told
/// about them, repetitions kept back.
class LiveOutput {
 public:
  LiveOutput(std::string source, std::size_t capacity, const Clock& clock);

  /// A frame with arbitrary content.
  std::shared_ptr<RgbdFrame> frame() { return pool_.take(); }
  void put(FramePtr frame) { box_.put(std::move(frame)); }
  /// A trouble of a kind that was said within the last two seconds is kept back, and counted.
  void notice(const std::string& kind, const std::string& what, const std::string& remedy = "", bool trouble = true);
  /// A frame that came and cannot be used.
  void skip(const std::string& what, const std::string& remedy);

  /// The number of a frame that the sensor gave this index; gaps in its counting are frames lost on the way.
  std::int64_t number(int index);
  /// The sensor counts from anew.
  void restart_numbers() { last_index_ = -1; }

  /// Any thread.
  EventBox& box() { return box_; }
  QueueHealth transit() const;

 private:
  const std::string source_;
  EventBox box_;
  RepeatFilter filter_;
  FramePool pool_;
  int last_index_ = -1;
  std::int64_t last_number_ = -1;
  std::atomic<std::int64_t> read_ = 0, lost_ = 0;
};

}  // namespace barehand
