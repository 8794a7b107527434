#pragma once

#include <optional>
#include <string>

#include "core/usb_bus.h"

namespace barehand {

/// Where an OpenNI2 sensor with this address ("1d27/0601@1/4") is on the USB bus; none: it is not there.
std::optional<UsbAddress> usb_address(const std::string& uri);

}  // namespace barehand
