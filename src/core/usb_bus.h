#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// One device on the USB bus between two plugs.
struct UsbAddress {
  std::uint16_t vendor = 0, product = 0;
  int bus = 0;
  int number = 0;  ///< counts up with every plug
  bool operator==(const UsbAddress&) const = default;
};

/// A depth sensor as the bus sees it, whether or not there is a driver for it.
struct UsbSensor {
  UsbAddress address;
  std::string name;               ///< its maker or kind
  std::string port;               ///< "1-2.3": bus 1, port 2 of the machine, port 3 of the hub there
  int megabits = 0;               ///< per second; 0: the bus does not tell
  bool held_back = false;         ///< could be faster in another port
  std::optional<Error> obstacle;  ///< why this program may not open it
};
/// "Orbbec 2bc5:0401 at USB port 1-2, USB 2 (480 Mb/s)".
std::string to_text(const UsbSensor& sensor);

/// The bus that sensors are plugged into. One thread, except where said.
class UsbBus {
 public:
  virtual ~UsbBus() = default;

  /// What is plugged in, sensors or not, as one text that changes with every plug pulled or put in; "": this machine
  /// does not tell.
  virtual std::string state() = 0;
  /// The known depth sensors that are plugged in. Error: the bus cannot be looked at.
  virtual Result<std::vector<UsbSensor>> sensors() = 0;
  /// Calls `changed` from a thread of its own whenever something is plugged in or pulled, until the bus is destroyed.
  /// Error: this machine does not tell; look at `state` from time to time.
  virtual Result<void> watch(std::function<void()> changed) = 0;
  /// As if the device were pulled and put in again; afterwards it may have another address. It must not be open.
  virtual Result<void> reset(const UsbAddress& device) = 0;
};

}  // namespace barehand
