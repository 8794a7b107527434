// The queue of one client of the live page, which keeps only the newest frame.
#include "io/web/newest_frame.h"

#include <utility>

namespace barehand {

void NewestFrame::post(ViewFramePtr frame) {
  ++pushed_;
  if (waiting_) ++dropped_;
  waiting_ = std::move(frame);
}

void NewestFrame::repeat() {
  if (waiting_ || !taken_) return;
  waiting_ = taken_;
  ++pushed_;
}

ViewFramePtr NewestFrame::take() {
  if (!waiting_) return nullptr;
  ++popped_;
  return taken_ = std::exchange(waiting_, nullptr);
}

QueueHealth NewestFrame::health() const { return {"view", 1, waiting_ ? 1u : 0u, pushed_, popped_, dropped_, {}}; }

void add_counts(const QueueHealth& one, QueueHealth& all) {
  all.depth += one.depth;
  all.pushed += one.pushed;
  all.popped += one.popped;
  all.dropped += one.dropped;
}

QueueHealth closed(QueueHealth health) {
  health.dropped += static_cast<std::int64_t>(health.depth);
  health.depth = 0;
  return health;
}

}  // namespace barehand
