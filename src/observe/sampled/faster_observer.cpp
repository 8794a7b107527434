#include "observe/sampled/faster_observer.h"

#include "observe/sampled/comparison_times.h"
#include "observe/sampled/fallback_observer.h"
#include "observe/sampled/watched_device.h"

namespace barehand {

// Times the first batch on the CPU and on the device, and keeps the faster one for all later batches.

FasterObserver::FasterObserver(std::unique_ptr<DeviceObserver> device, std::string name, std::unique_ptr<Observer> cpu,
                               std::shared_ptr<spdlog::logger> log, std::shared_ptr<const Clock> clock)
    : device_(std::move(device)),
      cpu_(std::move(cpu)),
      name_(std::move(name)),
      log_(std::move(log)),
      clock_(std::move(clock)) {}
FasterObserver::~FasterObserver() = default;

void FasterObserver::compare(const SampleBatch& batch, PatchDistances& distances) {
  if (chosen_)
    chosen_->compare(batch, distances);
  else
    choose(batch, distances);
}

void FasterObserver::choose(const SampleBatch& batch, PatchDistances& distances) {
  const auto times = time_comparison(batch, *cpu_, *device_, *clock_, distances);

  // If the device is faster, use it with the CPU as its fallback.
  if (times && times->device_is_faster()) {
    log_->info("samples are compared on {}: {} ({} samples)", name_, to_text(*times), batch.sample_count());
    auto watched = std::make_unique<WatchedDevice>(std::move(device_), times->cpu / batch.sample_count(), clock_);
    chosen_ = std::make_unique<FallbackObserver>(std::move(watched), std::move(cpu_), log_);
    return;
  }

  // Otherwise report why the CPU is used.
  if (times)
    log_->info("samples are compared on the CPU, not on {}: {} ({} samples)", name_, to_text(*times),
               batch.sample_count());
  else
    log_->warn("samples are compared on the CPU, not on {}: {}", name_, times.error().message());

  // Use the CPU from now on.
  chosen_ = std::move(cpu_);
  device_.reset();
}

}  // namespace barehand
