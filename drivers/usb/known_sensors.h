#pragma once

#include <cstdint>
#include <string>

namespace barehand {

/// What deploy/udev calls the depth sensor with these numbers; "": it is none that is known.
std::string known_sensor(std::uint16_t vendor, std::uint16_t product);

}  // namespace barehand
