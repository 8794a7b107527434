// The queue of one client of the live page, which keeps no more frames than the client has room for.
#include "io/web/waiting_frames.h"

#include <algorithm>
#include <utility>

namespace barehand {

void WaitingFrames::post(ViewFramePtr frame, std::size_t room) {
  ++pushed_;
  waiting_.push_back(std::move(frame));
  keep(room);
}

void WaitingFrames::keep(std::size_t room) {
  for (const std::size_t most = std::clamp<std::size_t>(room, 1, kMost); waiting_.size() > most; ++dropped_)
    waiting_.pop_front();
}

void WaitingFrames::repeat() {
  if (any() || !taken_) return;
  waiting_.push_back(taken_);
  ++pushed_;
}

ViewFramePtr WaitingFrames::take() {
  if (!any()) return nullptr;
  ++popped_;
  taken_ = std::move(waiting_.front());
  waiting_.pop_front();
  return taken_;
}

QueueHealth WaitingFrames::health() const { return {"view", kMost, waiting_.size(), pushed_, popped_, dropped_, {}}; }

void add_counts(const QueueHealth& one, QueueHealth& all) {
  all.capacity += one.capacity;
  all.depth += one.depth;
  all.pushed += one.pushed;
  all.popped += one.popped;
  all.dropped += one.dropped;
}

QueueHealth closed(QueueHealth health) {
  health.dropped += static_cast<std::int64_t>(health.depth);
  health.depth = health.capacity = 0;
  return health;
}

}  // namespace barehand
