#pragma once

#include <umockdev.h>

#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace barehand::test {

/// A USB tree simulated by umockdev. This process and its children, including libusb, see it instead of the machine's
/// bus. For this, libumockdev-preload.so.0 must be preloaded (by umockdev-wrapper).
class MockBus {
 public:
  MockBus() : testbed_(umockdev_testbed_new()) {}
  ~MockBus() { g_object_unref(testbed_); }
  MockBus(const MockBus&) = delete;
  MockBus& operator=(const MockBus&) = delete;

  struct Device {
    std::string port;  ///< for example "1-2"
    int bus = 1, number = 4;
    std::uint16_t vendor = 0x1d27, product = 0x0601;
    int megabits = 480;
    std::uint16_t usb_version = 0x0200;  ///< as the device states it
  };

  void plug(const Device& device) {
    // The device as umockdev's text format describes it.
    char text[1500];
    std::snprintf(
        text, sizeof(text),
        "P: %s\nN: bus/usb/%03d/%03d\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nE: BUSNUM=%03d\n"
        "E: DEVNUM=%03d\nE: DEVNAME=/dev/bus/usb/%03d/%03d\nA: busnum=%d\\n\nA: devnum=%d\\n\nA: speed=%d\\n\n"
        "A: bConfigurationValue=1\\n\nA: idVendor=%04x\\n\nA: idProduct=%04x\\n\n"
        "H: descriptors=1201%s000000%02x%s%s00010000000109021200010100803209040000000000ff00\n\n",
        path(device.port).c_str(), device.bus, device.number, device.bus, device.number, device.bus, device.number,
        device.bus, device.number, device.megabits, device.vendor, device.product, little(device.usb_version).c_str(),
        64, little(device.vendor).c_str(), little(device.product).c_str());

    // Add it and announce it.
    GError* error = nullptr;
    if (!umockdev_testbed_add_from_string(testbed_, text, &error)) throw std::runtime_error(error->message);
    umockdev_testbed_uevent(testbed_, ("/sys" + path(device.port)).c_str(), "add");
  }
  void pull(const std::string& port) {
    umockdev_testbed_uevent(testbed_, ("/sys" + path(port)).c_str(), "remove");
    umockdev_testbed_remove_device(testbed_, ("/sys" + path(port)).c_str());
  }

  /// The real path of the tree's root ("/dev", "/sys").
  std::string root() const {
    char* root = umockdev_testbed_get_root_dir(testbed_);
    const std::string text = root;
    g_free(root);
    return text;
  }
  UMockdevTestbed* testbed() { return testbed_; }

 private:
  static std::string path(const std::string& port) { return "/devices/pci0000:00/usb1/" + port; }
  static std::string little(std::uint16_t value) {
    char text[5];
    std::snprintf(text, sizeof(text), "%02x%02x", value & 0xff, value >> 8);
    return text;
  }

  UMockdevTestbed* testbed_;
};

}  // namespace barehand::test
