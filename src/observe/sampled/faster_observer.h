#pragma once

#include <spdlog/logger.h>

#include <memory>
#include <string>

#include "core/clock.h"
#include "observe/sampled/observer.h"

namespace barehand {

/// Whichever is faster: the first batch is compared by the CPU and by the device several times, and what was faster
/// compares all later ones; the log says by how much. The first batch's distances are the CPU's. A device that was
/// chosen is given up, in mid-frame, where it fails or becomes slower than the CPU (FallbackObserver, WatchedDevice).
class FasterObserver final : public Observer {
 public:
  /// `name`: of the device, for the log.
  FasterObserver(std::unique_ptr<DeviceObserver> device, std::string name, std::unique_ptr<Observer> cpu,
                 std::shared_ptr<spdlog::logger> log, std::shared_ptr<const Clock> clock);
  ~FasterObserver() override;
  void compare(const SampleBatch& batch, PatchDistances& distances) override;
  bool on_device() const override { return chosen_ && chosen_->on_device(); }

 private:
  void choose(const SampleBatch& batch, PatchDistances& distances);

  std::unique_ptr<DeviceObserver> device_;  // these two until one is chosen
  std::unique_ptr<Observer> cpu_, chosen_;
  std::string name_;
  std::shared_ptr<spdlog::logger> log_;
  std::shared_ptr<const Clock> clock_;
};

}  // namespace barehand
