#pragma once

#include <deque>

#include "core/statistics.h"
#include "io/web/view_frame.h"

namespace barehand {

/// The queue of frames of one client, which counts them. It keeps a short burst of frames that the client has room for,
/// so that none is lost while the sending thread waits for a processor; of those that must wait for the client it keeps
/// only the newest. Calls must be serialised by the owner.
class WaitingFrames {
 public:
  static constexpr std::size_t kMost = 16;  ///< a quarter of a second at 60 Hz

  bool any() const { return !waiting_.empty(); }
  /// Queues a frame. `room`: number of frames that may be sent at once. As many wait, but at least one and at most
  /// kMost; the oldest ones beyond that are dropped and counted.
  void post(ViewFramePtr frame, std::size_t room);
  /// Drops what exceeds a new `room`, as post() does.
  void keep(std::size_t room);
  /// Queues the frame taken last once more, unless a newer one waits or none was taken.
  void repeat();
  /// Takes the oldest waiting frame; null: there is none.
  ViewFramePtr take();
  QueueHealth health() const;

 private:
  std::deque<ViewFramePtr> waiting_;
  ViewFramePtr taken_;
  std::int64_t pushed_ = 0, popped_ = 0, dropped_ = 0;
};

/// Adds the counts, the depth and the capacity of `one` to `all`.
void add_counts(const QueueHealth& one, QueueHealth& all);
/// The counts of a client that leaves: what still waits is dropped, and its capacity is gone.
QueueHealth closed(QueueHealth health);

}  // namespace barehand
