// Calls a function whenever a USB device is plugged in or unplugged.
#include "drivers/usb/usb_watch.h"

#include <libusb.h>

namespace barehand {
namespace {

constexpr auto kEvents = LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT;

int tell(libusb_context*, libusb_device*, libusb_hotplug_event, void* changed) {
  (*static_cast<const std::function<void()>*>(changed))();
  return 0;  // 0 keeps the callback registered
}

}  // namespace

Result<std::unique_ptr<UsbWatch>> UsbWatch::start(std::function<void()> changed) {
  libusb_context* context = nullptr;
  if (const int status = libusb_init(&context); status != LIBUSB_SUCCESS)
    return fail(std::string("the bus cannot be watched: ") + libusb_strerror(status), "USB", "");
  std::unique_ptr<UsbWatch> watch(new UsbWatch(context, std::move(changed)));

  // Register for all devices.
  constexpr int kAny = LIBUSB_HOTPLUG_MATCH_ANY;
  const int status = libusb_hotplug_register_callback(context, kEvents, 0, kAny, kAny, kAny, tell,
                                                      const_cast<std::function<void()>*>(&watch->changed_), nullptr);
  if (status != LIBUSB_SUCCESS)
    return fail(std::string("changes on the bus cannot be watched: ") + libusb_strerror(status), "USB", "");

  watch->thread_ = std::thread([watch = watch.get()] { watch->run(); });
  return watch;
}

void UsbWatch::run() {
  while (!stop_) {
    timeval patience{1, 0};  // limits the wait, in case the interruption came just before it
    libusb_handle_events_timeout(context_, &patience);
  }
}

UsbWatch::~UsbWatch() {
  stop_ = true;
  libusb_interrupt_event_handler(context_);
  if (thread_.joinable()) thread_.join();
  libusb_exit(context_);
}

}  // namespace barehand
