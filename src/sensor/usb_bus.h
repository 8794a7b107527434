#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

// Depth sensors on the USB bus.

/// A device on the USB bus, valid until it is unplugged.
struct UsbAddress {
  std::uint16_t vendor = 0, product = 0;
  int bus = 0;
  int number = 0;  ///< assigned by the bus; a new one every time the device is plugged in
  bool operator==(const UsbAddress&) const = default;
};

/// A depth sensor as the USB bus reports it, whether or not a driver for it is installed.
struct UsbSensor {
  UsbAddress address;
  std::string name;               ///< maker or model, for example "Orbbec"
  std::string port;               ///< "1-2.3": bus 1, port 2 of the machine, port 3 of the hub there
  int megabits = 0;               ///< speed in Mb/s; 0: the bus does not report it
  bool held_back = false;         ///< whether the sensor supports a higher speed than this port provides
  std::optional<Error> obstacle;  ///< why this program has no permission to open it; none: it has
};
/// Text for messages, such as "Orbbec 2bc5:0401 at USB port 1-2, USB 2 (480 Mb/s)".
std::string to_text(const UsbSensor& sensor);

/// The USB bus. For use by one thread, except where stated otherwise.
class UsbBus {
 public:
  virtual ~UsbBus() = default;

  /// Describes everything that is plugged in as a text that changes whenever something is plugged in or unplugged; ""
  /// if this machine does not support it.
  virtual std::string state() = 0;
  /// The known depth sensors that are plugged in. Error: the bus cannot be read.
  virtual Result<std::vector<UsbSensor>> sensors() = 0;
  /// Calls `changed` from a thread of its own whenever something is plugged in or unplugged, until the bus is
  /// destroyed. Error: this machine does not support it; poll `state` instead.
  virtual Result<void> watch(std::function<void()> changed) = 0;
  /// Has the same effect as unplugging the device and plugging it in again; it may get another address. It must not be
  /// open.
  virtual Result<void> reset(const UsbAddress& device) = 0;
};

}  // namespace barehand
