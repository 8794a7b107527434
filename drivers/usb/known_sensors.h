#pragma once

#include <cstdint>
#include <string>

namespace barehand {

/// The name that deploy/udev gives to the depth sensor with these USB vendor and product ids; "" if it is not
/// known.
std::string known_sensor(std::uint16_t vendor, std::uint16_t product);

}  // namespace barehand
