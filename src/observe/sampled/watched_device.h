#pragma once

#include <memory>

#include "core/clock.h"
#include "observe/sampled/observer.h"

namespace barehand {

/// Uses a device as long as it is faster than the CPU. The time that its calls lose compared with the CPU is summed up;
/// faster calls reduce the sum, but not below zero. When the sum reaches kMostLost, compare() fails. So a single slow
/// call has no effect, and a device that is always a little too slow is given up in the end.
class WatchedDevice final : public DeviceObserver {
 public:
  static constexpr double kMostLost = 0.5;  // largest loss of time before the device is given up [s]

  /// `cpu_seconds`: time of the CPU for one sample [s].
  WatchedDevice(std::unique_ptr<DeviceObserver> device, double cpu_seconds, std::shared_ptr<const Clock> clock)
      : device_(std::move(device)), cpu_seconds_(cpu_seconds), clock_(std::move(clock)) {}
  Result<void> compare(const SampleBatch& batch, PatchDistances& distances) override;

 private:
  std::unique_ptr<DeviceObserver> device_;
  double cpu_seconds_;
  std::shared_ptr<const Clock> clock_;
  double lost_ = 0;  // time lost compared with the CPU [s]
};

}  // namespace barehand
