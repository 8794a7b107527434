#include "drivers/usb/known_sensors.h"

namespace barehand {
namespace {

struct KnownSensor {
  std::uint16_t vendor, product;
  bool any_product;
  const char* name;
};
constexpr KnownSensor kKnownSensors[] = {
#include "known_sensors.inc"  // generated from deploy/udev
};

}  // namespace

std::string known_sensor(std::uint16_t vendor, std::uint16_t product) {
  for (const KnownSensor& known : kKnownSensors)
    if (known.vendor == vendor && (known.any_product || known.product == product)) return known.name;
  return "";
}

}  // namespace barehand
