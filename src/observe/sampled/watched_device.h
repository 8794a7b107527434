#pragma once

#include <memory>

#include "core/clock.h"
#include "observe/sampled/observer.h"

namespace barehand {

/// A device that is used as long as it is faster than the CPU: the time that its calls lose against the CPU's is added
/// up, what they gain pays it back, and where the loss reaches kMostLost the device fails. So a single slow call is
/// forgiven, and one that is a little too slow is noticed in the end. Earlier gains are not saved up.
class WatchedDevice final : public DeviceObserver {
 public:
  static constexpr double kMostLost = 0.5;  // s

  /// `cpu_seconds`: of the CPU, for one sample.
  WatchedDevice(std::unique_ptr<DeviceObserver> device, double cpu_seconds, std::shared_ptr<const Clock> clock)
      : device_(std::move(device)), cpu_seconds_(cpu_seconds), clock_(std::move(clock)) {}
  Result<void> compare(const SampleBatch& batch, PatchDistances& distances) override;

 private:
  std::unique_ptr<DeviceObserver> device_;
  double cpu_seconds_;
  std::shared_ptr<const Clock> clock_;
  double lost_ = 0;  // s
};

}  // namespace barehand
