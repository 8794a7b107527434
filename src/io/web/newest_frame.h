#pragma once

#include "core/statistics.h"
#include "io/web/view_frame.h"

namespace barehand {

/// The queue of frames of one client. Of the frames that were not sent yet it keeps only the newest, and it counts
/// them. Calls must be serialised by the owner.
class NewestFrame {
 public:
  bool waiting() const { return waiting_ != nullptr; }
  /// Queues a frame. A waiting frame is replaced and counted as dropped.
  void post(ViewFramePtr frame);
  /// Queues the frame taken last once more, unless a newer one waits or none was taken.
  void repeat();
  /// Takes the waiting frame; null: there is none.
  ViewFramePtr take();
  /// The counts, as of a queue with a capacity of one.
  QueueHealth health() const;

 private:
  ViewFramePtr waiting_, taken_;
  std::int64_t pushed_ = 0, popped_ = 0, dropped_ = 0;
};

/// Adds the counts and the depth of `one` to `all`.
void add_counts(const QueueHealth& one, QueueHealth& all);
/// The counts of a client that leaves: what still waits is dropped.
QueueHealth closed(QueueHealth health);

}  // namespace barehand
