#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "core/clock.h"
#include "core/usb_bus.h"
#include "drivers/openni2/library.h"

namespace barehand {

/// Finds a sensor on a bus that changes. Drivers that do not watch the bus themselves see a change only when OpenNI2 is
/// loaded anew; that costs memory each time (about 0.13 MB), so it is done when something was plugged, and else once a
/// day, or every ten minutes where the bus does not tell.
class OpenNiFinder {
 public:
  /// `wanted`: an address or a part of one; "": the first sensor found. `came`: on any thread, look again. `usb`
  /// outlives the finder; null: no bus to look at.
  OpenNiFinder(std::string wanted, std::function<void()> came, UsbBus* usb, const Clock& clock);

  /// The address of the wanted sensor. Errors: OpenNI2 does not start, there is no such sensor.
  Result<std::string> find();
  /// The sensor was found but could not be used: OpenNI2's knowledge may be out of date.
  void distrust();
  /// Lets go of OpenNI2.
  void unload() { library_.reset(); }
  /// Whether the sensor at this address went since `find`.
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
  std::vector<std::string> gone_;  // guarded by the mutex
  std::unique_ptr<OpenNiLibrary> library_;
  std::string bus_when_loaded_;
  std::int64_t looked_us_ = 0, loaded_us_ = 0;
};

}  // namespace barehand
