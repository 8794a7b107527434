#pragma once

#include <optional>
#include <string>

#include "sensor/usb_bus.h"

namespace barehand {

/// The place on the USB bus of an OpenNI2 sensor with an address like "1d27/0601@1/4"; none if it is not a USB
/// address.
std::optional<UsbAddress> usb_address(const std::string& uri);

}  // namespace barehand
