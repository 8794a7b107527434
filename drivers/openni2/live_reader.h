#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>

#include "drivers/openni2/backoff.h"
#include "drivers/openni2/finder.h"
#include "drivers/openni2/live_session.h"
#include "sensor/usb_bus.h"

namespace barehand {

/// Finds a live sensor, opens it and reads it, on the thread that calls run(). When the sensor is lost, stalls or
/// delivers invalid images, this starts again, until a stop is requested.
class LiveReader {
 public:
  /// `wanted` and `capacity`: see OpenNiLiveSource. `usb`: the bus to which the sensor may be connected; null: no bus
  /// is watched.
  LiveReader(const std::string& wanted, const OpenNiParams& params, std::size_t capacity, const Clock& clock,
             std::unique_ptr<UsbBus> usb);

  /// Runs until a stop is requested and the sensor's driver returns. `clock` is not used after the request.
  void run();
  /// Any thread may call it.
  void request_stop();
  /// Any thread may call it.
  LiveOutput& output() { return output_; }

 private:
  // Finds and opens the sensor; waits if that fails.
  void connect();
  // Reads the open sensor; closes it if it is lost.
  void follow();
  std::string usb_port(const std::string& uri) const;
  // Resets the sensor's USB port.
  void reset(const std::string& uri);
  void wait(std::chrono::milliseconds duration);
  // Wakes the thread, because something on the bus has changed.
  void look_again();

  const OpenNiParams params_;
  const Clock& clock_;
  LiveOutput output_;

  std::mutex mutex_;  // guards changed_
  std::condition_variable wake_;
  bool changed_ = false;
  std::atomic<bool> stop_ = false;

  Backoff backoff_;
  int silent_ = 0;  ///< number of times in a row that the sensor was opened and never answered
  int resets_ = 0;  ///< number of resets since the sensor last answered
  const std::unique_ptr<UsbBus> usb_;
  OpenNiFinder finder_;
  std::unique_ptr<LiveSession> session_;  // destroyed before the finder, which unloads the drivers
};

}  // namespace barehand
