// The USB bus of this machine, accessed through libusb.
#include "drivers/usb/libusb_bus.h"

#include <algorithm>

#include "core/format.h"
#include "drivers/usb/known_sensors.h"
#include "drivers/usb/usb_listing.h"
#include "drivers/usb/usb_watch.h"

namespace barehand {
namespace {

/// Speed of the device's connection [Mb/s]; 0 if it is not known.
int megabits(libusb_device* device) {
  switch (libusb_get_device_speed(device)) {
    case LIBUSB_SPEED_LOW:
      return 2;  // 1.5 Mb/s, rounded up
    case LIBUSB_SPEED_FULL:
      return 12;
    case LIBUSB_SPEED_HIGH:
      return 480;
    case LIBUSB_SPEED_SUPER:
      return 5000;
    case LIBUSB_SPEED_SUPER_PLUS:
      return 10000;
    default:
      return 0;
  }
}

/// Whether the device's descriptor names a faster bus than the one it is connected to. A USB 3 device reports 2.1 at a
/// USB 2 port.
bool held_back(libusb_device* device) {
  libusb_device_descriptor descriptor{};
  libusb_get_device_descriptor(device, &descriptor);
  const int speed = megabits(device);
  return speed > 0 && (speed < 480 ? descriptor.bcdUSB >= 0x0200 : speed < 5000 && descriptor.bcdUSB >= 0x0210);
}

}  // namespace

LibUsbBus::LibUsbBus() = default;

LibUsbBus::~LibUsbBus() = default;

std::string LibUsbBus::state() {
  const auto listing = UsbListing::take();
  if (!listing) return "";
  std::vector<std::string> plugged;
  for (libusb_device* device : listing->devices())
    plugged.push_back(formatted("%s#%d ", port_of(device).c_str(), libusb_get_device_address(device)));
  std::sort(plugged.begin(), plugged.end());
  std::string state;
  for (const std::string& device : plugged) state += device;
  return state;
}

Result<std::vector<UsbSensor>> LibUsbBus::sensors() {
  const auto listing = UsbListing::take();
  if (!listing) return tl::unexpected(listing.error());
  std::vector<UsbSensor> found;

  // Look for known sensors, and check whether this user may open them.
  for (libusb_device* device : listing->devices()) {
    const UsbAddress address = address_of(device);
    const std::string name = known_sensor(address.vendor, address.product);
    if (name.empty()) continue;

    UsbSensor sensor{address, name, port_of(device), megabits(device), held_back(device), {}};
    if (const auto handle = open_usb(device); !handle) sensor.obstacle = handle.error();
    found.push_back(std::move(sensor));
  }
  return found;
}

Result<void> LibUsbBus::watch(std::function<void()> changed) {
  auto watch = UsbWatch::start(std::move(changed));
  if (!watch) return tl::unexpected(watch.error());
  watch_ = std::move(*watch);
  return {};
}

Result<void> LibUsbBus::reset(const UsbAddress& address) {
  // Find the device.
  const auto listing = UsbListing::take();
  if (!listing) return tl::unexpected(listing.error());
  const auto devices = listing->devices();
  const auto device =
      std::find_if(devices.begin(), devices.end(), [&](libusb_device* d) { return address_of(d) == address; });
  const std::string where = formatted("USB device %04x:%04x on bus %d, number %d", address.vendor, address.product,
                                      address.bus, address.number);

  // Reset the device.
  if (device == devices.end()) return fail("is no longer plugged in", where, "plug it in");
  const auto handle = open_usb(*device);
  if (!handle) return tl::unexpected(handle.error());
  const int status = libusb_reset_device(handle->get());
  if (status != LIBUSB_SUCCESS && status != LIBUSB_ERROR_NOT_FOUND)  // not found: the reset gave it another number
    return fail(std::string("cannot be reset: ") + libusb_strerror(status), where, "re-plug it");
  return {};
}

}  // namespace barehand
