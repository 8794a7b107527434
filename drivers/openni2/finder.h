#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "core/clock.h"
#include "drivers/openni2/library.h"
#include "sensor/usb_bus.h"

namespace barehand {

/// Finds a sensor while USB devices are plugged and unplugged. Some OpenNI2 drivers do not watch the bus and see a
/// change only when OpenNI2 is loaded again. Each loading costs memory (about 0.13 MB), so it is done only when the
/// devices on the bus have changed, and otherwise once a day, or every ten minutes if the devices on the bus cannot be
/// listed.
class OpenNiFinder {
 public:
  /// `wanted`: an address or a part of one; "": the first sensor found. `came`: called on any thread when a new call of
  /// `find` may give another result. `usb` must outlive the finder; null: the devices on the bus are not known.
  OpenNiFinder(std::string wanted, std::function<void()> came, UsbBus* usb, const Clock& clock);

  /// The address of the wanted sensor. Errors: OpenNI2 does not start, or there is no such sensor.
  Result<std::string> find();
  /// Call when the sensor was found but cannot be used, because OpenNI2's view of the bus may be out of date.
  void distrust();
  /// Call it, on any thread, when the bus reports a change: if OpenNI2 was loaded in the middle of the change, it may
  /// have seen the device incompletely.
  void bus_changed() { told_ = true; }
  /// Unloads OpenNI2.
  void unload() { library_.reset(); }
  /// Whether the sensor at this address was unplugged since the last call of `find`.
  bool gone(const std::string& uri) const;

 private:
  Result<void> load();
  std::string bus_state() const { return usb_ ? usb_->state() : ""; }
  tl::unexpected<Error> not_found(const std::string& others) const;
  std::string whom() const { return wanted_.empty() ? "no sensor" : "no sensor with " + wanted_ + " in its address"; }

  const std::string wanted_;
  const std::function<void()> came_;
  UsbBus* const usb_;
  const Clock& clock_;
  mutable std::mutex mutex_;
  std::vector<std::string> gone_;  // addresses of sensors that were unplugged; guarded by mutex_
  std::unique_ptr<OpenNiLibrary> library_;
  std::string bus_when_loaded_;
  std::atomic<bool> told_ = false;  // whether the bus has reported a change since OpenNI2 was loaded
  std::int64_t looked_us_ = 0, loaded_us_ = 0;
};

}  // namespace barehand
