#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>

#include "core/usb_bus.h"
#include "drivers/openni2/backoff.h"
#include "drivers/openni2/finder.h"
#include "drivers/openni2/live_session.h"

namespace barehand {

/// What goes on on a live sensor's thread: finds it, opens it, reads it, and when it is lost, stalls or talks nonsense
/// starts over, for as long as nobody stops it.
class LiveReader {
 public:
  /// `usb`: the bus that the sensor may be on; null: none is looked at.
  LiveReader(const std::string& wanted, const OpenNiParams& params, std::size_t capacity, const Clock& clock,
             std::unique_ptr<UsbBus> usb);

  /// Returns some time after a stop was requested: when the sensor's driver lets go. `clock` is then not used any more.
  void run();
  /// Any thread.
  void request_stop();
  /// Any thread.
  LiveOutput& output() { return output_; }

 private:
  void connect();
  void follow();
  std::string usb_port(const std::string& uri) const;
  void reset(const std::string& uri);
  void wait(std::chrono::milliseconds duration);
  void look_again();

  const OpenNiParams params_;
  const Clock& clock_;
  LiveOutput output_;

  std::mutex mutex_;  // of the next two
  std::condition_variable wake_;
  bool changed_ = false;
  std::atomic<bool> stop_ = false;

  Backoff backoff_;
  int silent_ = 0;  ///< times in a row that the sensor was opened and never answered
  int resets_ = 0;  ///< since it last answered
  const std::unique_ptr<UsbBus> usb_;
  OpenNiFinder finder_;
  std::unique_ptr<LiveSession> session_;  // before the finder goes, which unloads the drivers
};

}  // namespace barehand
