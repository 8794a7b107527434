#pragma once

#include <string>

namespace barehand {

/// What is plugged in, as one text that changes with every plug pulled or put in; "": this machine does not tell.
std::string usb_bus_state(const std::string& folder = "/sys/bus/usb/devices");

}  // namespace barehand
