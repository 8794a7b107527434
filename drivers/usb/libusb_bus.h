#pragma once

#include <memory>

#include "sensor/usb_bus.h"

namespace barehand {

class UsbWatch;

/// The USB bus of this machine, accessed through libusb.
class LibUsbBus : public UsbBus {
 public:
  LibUsbBus();
  ~LibUsbBus() override;

  std::string state() override;
  Result<std::vector<UsbSensor>> sensors() override;
  Result<void> watch(std::function<void()> changed) override;
  Result<void> reset(const UsbAddress& device) override;

 private:
  std::unique_ptr<UsbWatch> watch_;
};

}  // namespace barehand
