#pragma once

#include <spdlog/logger.h>

#include <memory>
#include <string>

#include "core/clock.h"
#include "observe/sampled/observer.h"

namespace barehand {

/// Uses the CPU or a device, whichever is faster. The first batch is compared by both several times; the faster one
/// compares all later batches, and the times are logged. The first batch's distances are the CPU's. The CPU replaces a
/// chosen device, even within a frame, if the device fails or becomes slower than the CPU (FallbackObserver,
/// WatchedDevice).
class FasterObserver final : public Observer {
 public:
  /// `name`: the device's name for the log.
  FasterObserver(std::unique_ptr<DeviceObserver> device, std::string name, std::unique_ptr<Observer> cpu,
                 std::shared_ptr<spdlog::logger> log, std::shared_ptr<const Clock> clock);
  ~FasterObserver() override;
  void compare(const SampleBatch& batch, PatchDistances& distances) override;
  bool on_device() const override { return chosen_ && chosen_->on_device(); }

 private:
  void choose(const SampleBatch& batch, PatchDistances& distances);

  std::unique_ptr<DeviceObserver> device_;  // this and cpu_ are null once one of them is chosen
  std::unique_ptr<Observer> cpu_, chosen_;
  std::string name_;
  std::shared_ptr<spdlog::logger> log_;
  std::shared_ptr<const Clock> clock_;
};

}  // namespace barehand
