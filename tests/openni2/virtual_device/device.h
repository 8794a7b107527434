#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "openni2/virtual_device/settings.h"
#include "openni2/virtual_device/stream.h"

namespace barehand::virtual_openni {

/// An open virtual sensor: a thread exposes images at the sensor's rate and passes them to its streams.
class Device : public oni::driver::DeviceBase {
 public:
  using CurrentSettings = std::function<std::shared_ptr<const Settings>()>;

  Device(const Pictures& pictures, CurrentSettings settings);
  ~Device() override;

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override;
  oni::driver::StreamBase* createStream(OniSensorType sensor) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;
  OniStatus tryManualTrigger() override { return ONI_STATUS_OK; }

 private:
  void expose_pictures(std::stop_token stop);
  void expose(const Settings& now, std::int64_t since_open_us);
  std::string fault(const Settings& now) const;

  const Pictures& pictures_;
  const CurrentSettings settings_;
  const std::shared_ptr<const Settings> at_open_;
  std::array<std::array<OniVideoMode, 2>, 2> modes_;
  std::array<OniSensorInfo, 2> sensors_;
  std::mutex streams_mutex_;
  std::vector<std::unique_ptr<Stream>> streams_;
  std::atomic<bool> registered_ = false;
  // Permanent, as a sensor that is plugged in again is another device; like the next members, used by the exposing
  // thread only.
  bool unplugged_ = false;
  int index_ = 0;
  std::int64_t frozen_at_ = -1;
  std::jthread exposing_;  // last, as it uses everything above
};

}  // namespace barehand::virtual_openni
