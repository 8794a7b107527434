// Lists the devices that are on the USB bus now.
#include "drivers/usb/usb_listing.h"

#include <array>

#include "core/format.h"

namespace barehand {

Result<UsbListing> UsbListing::take() {
  UsbListing listing;
  libusb_context* context = nullptr;
  int status = libusb_init(&context);
  listing.context_.reset(context);
  libusb_device** devices = nullptr;

  // List the devices; the list must be freed however this function ends.
  if (status == LIBUSB_SUCCESS) {
    const auto count = libusb_get_device_list(context, &devices);
    listing.devices_.reset(devices);
    listing.count_ = count > 0 ? static_cast<std::size_t>(count) : 0;
    status = count < 0 ? static_cast<int>(count) : LIBUSB_SUCCESS;
  }

  if (status != LIBUSB_SUCCESS)
    return fail(std::string("the devices on the bus cannot be listed: ") + libusb_strerror(status), "USB",
                "in a container, pass in /dev/bus/usb and /sys");
  return listing;
}

UsbAddress address_of(libusb_device* device) {
  libusb_device_descriptor descriptor{};
  libusb_get_device_descriptor(device, &descriptor);
  return {descriptor.idVendor, descriptor.idProduct, libusb_get_bus_number(device), libusb_get_device_address(device)};
}

std::string port_of(libusb_device* device) {
  std::array<std::uint8_t, 7> ports{};  // the largest depth of a USB tree is 7
  const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
  std::string text = std::to_string(libusb_get_bus_number(device));
  for (int i = 0; i < depth; ++i) text += formatted("%c%d", i == 0 ? '-' : '.', ports[static_cast<std::size_t>(i)]);
  return text;
}

Result<UsbHandle> open_usb(libusb_device* device) {
  // Open the device by its file.
  const std::string file =
      formatted("/dev/bus/usb/%03d/%03d", libusb_get_bus_number(device), libusb_get_device_address(device));
  libusb_device_handle* handle = nullptr;
  switch (const int status = libusb_open(device, &handle)) {
    case LIBUSB_SUCCESS:
      return UsbHandle(handle);

    // Report the fault with its remedy.
    case LIBUSB_ERROR_ACCESS:
      return fail("this user may not open it", file,
                  "install deploy/udev/60-barehand-sensors.rules, add the user to the group plugdev (sudo adduser USER "
                  "plugdev), log in again and re-plug it");
    case LIBUSB_ERROR_NO_DEVICE:
      return fail("it has no device file", file, "in a container, pass in /dev/bus/usb; else re-plug it");

    // Any other fault is reported as libusb describes it.
    default:
      return fail(std::string("cannot be opened: ") + libusb_strerror(status), file, "re-plug it");
  }
}

}  // namespace barehand
