// A plug-in that OpenNI2 loads like the driver of a real sensor. It simulates hands in front of a depth camera, with
// all faults that its control file requests.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <map>

#include "openni2/virtual_device/device.h"

namespace barehand::virtual_openni {

class Driver : public oni::driver::DriverBase {
 public:
  explicit Driver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, changed, cookie);
    follow_settings();
    watching_ = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        follow_settings();
      }
    });
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char*, const char*) override {
    // A device that is unplugged or busy cannot be opened.
    const auto now = settings();
    if (!now->plugged || now->fault == "open") {
      getServices().errorLoggerAppend("virtual device: %s", now->plugged ? "busy" : "unplugged");
      return nullptr;
    }

    // Render the images once for each scene.
    const std::lock_guard lock(pictures_mutex_);
    const std::string key = now->sim + "/" + std::to_string(now->frames);
    if (!pictures_.contains(key)) {
      auto rendered = render_pictures(now->sim, now->frames);
      if (!rendered) {
        getServices().errorLoggerAppend("virtual device: %s", rendered.error().message().c_str());
        return nullptr;
      }
      pictures_[key] = std::move(*rendered);
    }

    return new Device(pictures_[key], [this] { return settings(); });
  }
  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }

  OniStatus tryDevice(const char*) override { return ONI_STATUS_ERROR; }
  void shutdown() override {
    watching_.request_stop();
    if (watching_.joinable()) watching_.join();
  }

  void* enableFrameSync(oni::driver::StreamBase**, int) override {
    return settings()->sync || settings()->lies ? static_cast<void*>(this) : nullptr;
  }
  void disableFrameSync(void*) override {}

 private:
  std::shared_ptr<const Settings> settings() const {
    const std::lock_guard lock(settings_mutex_);
    return settings_;
  }

  void follow_settings() {
    // Read the control file.
    auto now = read_settings();
    std::vector<std::string> wanted;
    if (now->plugged) wanted.push_back(now->uri);
    if (!now->second_uri.empty()) wanted.push_back(now->second_uri);
    {
      const std::lock_guard lock(settings_mutex_);
      settings_ = std::move(now);
    }

    // No lock is held while OpenNI2 calls its listeners, because they may open a device.
    for (const std::string& uri : std::vector(present_))
      if (std::ranges::find(wanted, uri) == wanted.end()) unplug(uri);
    for (const std::string& uri : wanted)
      if (std::ranges::find(present_, uri) == present_.end()) plug(uri);
  }

  static OniDeviceInfo info(const std::string& uri) {
    OniDeviceInfo info{};
    std::snprintf(info.uri, sizeof info.uri, "%s", uri.c_str());
    std::snprintf(info.vendor, sizeof info.vendor, "Barehand");
    std::snprintf(info.name, sizeof info.name, "Virtual Sensor");
    return info;
  }
  void plug(const std::string& uri) {
    const OniDeviceInfo device = info(uri);
    present_.push_back(uri);
    deviceConnected(&device);
  }
  void unplug(const std::string& uri) {
    const OniDeviceInfo device = info(uri);
    std::erase(present_, uri);
    deviceDisconnected(&device);
  }

  mutable std::mutex settings_mutex_;
  std::shared_ptr<const Settings> settings_;
  std::vector<std::string> present_;  // used first by initialize(), then by the watching thread
  std::mutex pictures_mutex_;
  std::map<std::string, Pictures> pictures_;
  std::jthread watching_;  // last, as it uses everything above
};

}  // namespace barehand::virtual_openni

using VirtualDriver = barehand::virtual_openni::Driver;
ONI_EXPORT_DRIVER(VirtualDriver)
