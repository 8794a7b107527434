#pragma once

#include <future>
#include <memory>
#include <string>
#include <thread>

#include "core/clock.h"
#include "drivers/openni2/openni_params.h"
#include "sensor/frame_source.h"
#include "sensor/usb_bus.h"

namespace barehand {

class LiveReader;

/// Frames from an OpenNI2 sensor. It opens at once and never fails: it waits for a sensor that is absent, unplugged or
/// faulty, and reports what is wrong as SourceNotice. A separate thread reads the sensor and keeps the newest frames
/// for `next`.
class OpenNiLiveSource : public FrameSource {
 public:
  /// `wanted`: an address or a part of one, as `barehand doctor` lists them; "": the first sensor found. `capacity`:
  /// the number of frames that may wait. `clock` must outlive the source. `usb`: the bus to which the sensor may be
  /// connected; it lets a new sensor be noticed at once and a hanging one be reset. Null: the sensor is looked for
  /// from time to time.
  OpenNiLiveSource(const std::string& wanted, const OpenNiParams& params, std::size_t capacity, const Clock& clock,
                   std::unique_ptr<UsbBus> usb = nullptr);
  /// Waits for the sensor's driver to return, but only for a short time; the thread of a driver that hangs is detached.
  ~OpenNiLiveSource() override;

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return true; }
  std::string name() const override { return name_; }
  /// "transit" counts the frames on the way from the sensor, "inbox" those that wait here.
  std::vector<QueueHealth> queues() const override;

 private:
  const std::string name_;
  std::shared_ptr<LiveReader> reader_;  // shared with the thread, which may outlive this object
  std::shared_future<void> finished_;
  std::thread thread_;
};

}  // namespace barehand
