#include "sensor/usb_bus.h"

#include "core/format.h"

namespace barehand {

std::string to_text(const UsbSensor& sensor) {
  const int generation = sensor.megabits >= 5000 ? 3 : sensor.megabits >= 480 ? 2 : 1;
  const std::string speed =
      sensor.megabits == 0 ? "speed not known" : formatted("USB %d (%d Mb/s)", generation, sensor.megabits);
  return sensor.name + formatted(" %04x:%04x at USB port ", sensor.address.vendor, sensor.address.product) +
         sensor.port + ", " + speed;
}

}  // namespace barehand
