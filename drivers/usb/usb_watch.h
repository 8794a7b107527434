#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <thread>

#include "core/error.h"

struct libusb_context;

namespace barehand {

/// Calls a function from a thread of its own whenever a device is plugged in or unplugged, for as long as the object
/// lives.
class UsbWatch {
 public:
  /// Starts the thread. Error: libusb cannot watch the bus on this machine.
  static Result<std::unique_ptr<UsbWatch>> start(std::function<void()> changed);
  ~UsbWatch();
  UsbWatch(const UsbWatch&) = delete;
  UsbWatch& operator=(const UsbWatch&) = delete;

 private:
  UsbWatch(libusb_context* context, std::function<void()> changed) : context_(context), changed_(std::move(changed)) {}
  void run();

  libusb_context* const context_;
  const std::function<void()> changed_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace barehand
