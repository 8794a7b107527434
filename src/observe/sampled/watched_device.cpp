#include "observe/sampled/watched_device.h"

#include <algorithm>

#include "core/format.h"

namespace barehand {

Result<void> WatchedDevice::compare(const SampleBatch& batch, PatchDistances& distances) {
  const std::int64_t start = clock_->steady_us();
  const auto done = device_->compare(batch, distances);
  if (!done) return done;
  const double seconds = static_cast<double>(clock_->steady_us() - start) * 1e-6;
  const double by_cpu = cpu_seconds_ * batch.sample_count();
  lost_ = std::max(0.0, lost_ + seconds - by_cpu);
  if (lost_ < kMostLost) return {};
  return fail(formatted("it became slower than the CPU, the last call with %.2f ms instead of %.2f ms", 1e3 * seconds,
                        1e3 * by_cpu),
              "GPU", "see what else uses it");
}

}  // namespace barehand
