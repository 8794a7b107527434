#pragma once

#include <spdlog/logger.h>

#include <memory>

#include "observe/sampled/observer.h"

namespace barehand {

/// Uses a device as long as it works. The batch on which it fails, and all later ones, are compared by a second
/// observer that cannot fail. The change is logged once.
class FallbackObserver final : public Observer {
 public:
  FallbackObserver(std::unique_ptr<DeviceObserver> device, std::unique_ptr<Observer> other,
                   std::shared_ptr<spdlog::logger> log)
      : device_(std::move(device)), other_(std::move(other)), log_(std::move(log)) {}
  void compare(const SampleBatch& batch, PatchDistances& distances) override;
  bool on_device() const override { return device_ != nullptr; }

 private:
  std::unique_ptr<DeviceObserver> device_;  ///< null after it failed
  std::unique_ptr<Observer> other_;
  std::shared_ptr<spdlog::logger> log_;
};

}  // namespace barehand
