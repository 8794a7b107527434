#pragma once

#include <libusb.h>

#include <memory>
#include <span>

#include "sensor/usb_bus.h"

namespace barehand {

/// The devices that are on the bus now. The bus is scanned for every listing, because a list that libusb maintains
/// depends on udev, which some containers lack.
class UsbListing {
 public:
  /// Scans the bus. Error: libusb finds no bus.
  static Result<UsbListing> take();

  std::span<libusb_device* const> devices() const { return {devices_.get(), count_}; }

 private:
  struct Exit {
    void operator()(libusb_context* context) const { libusb_exit(context); }
  };
  struct Free {
    void operator()(libusb_device** devices) const { libusb_free_device_list(devices, 1); }
  };
  std::unique_ptr<libusb_context, Exit> context_;
  std::unique_ptr<libusb_device*[], Free> devices_;  // must be freed before the context
  std::size_t count_ = 0;
};

/// An open device; it is closed when the handle is destroyed.
struct CloseUsb {
  void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
};
using UsbHandle = std::unique_ptr<libusb_device_handle, CloseUsb>;

// The address of a device (vendor, product, bus and number), and its port, such as "1-2.3".
UsbAddress address_of(libusb_device* device);
std::string port_of(libusb_device* device);
/// Opens a device without disturbing it. Errors: the permission is missing, the device was unplugged, there is no
/// device file.
Result<UsbHandle> open_usb(libusb_device* device);

}  // namespace barehand
