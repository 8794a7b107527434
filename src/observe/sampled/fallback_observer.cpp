#include "observe/sampled/fallback_observer.h"

namespace barehand {

void FallbackObserver::compare(const SampleBatch& batch, PatchDistances& distances) {
  if (device_) {
    const auto done = device_->compare(batch, distances);
    if (done) return;
    log_->warn("samples are compared on the CPU from now on, not on the GPU: {}", done.error().message());
    device_.reset();
  }
  other_->compare(batch, distances);
}

}  // namespace barehand
