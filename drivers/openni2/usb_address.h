#pragma once

#include <optional>
#include <string>

#include "sensor/usb_bus.h"

namespace barehand {

/// The USB address that an OpenNI2 address like "1d27/0601@1/4" states; none if it is not the address of a USB device.
std::optional<UsbAddress> usb_address(const std::string& uri);

}  // namespace barehand
