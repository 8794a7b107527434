#pragma once

#include <OpenNI.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// Keeps OpenNI2 loaded in this process. OpenNI2 counts its users; the last one unloads the drivers.
class OpenNiLibrary {
 public:
  /// Reports that the sensor at the address `uri` was plugged in (`came` is true) or unplugged. Called on a thread of
  /// the sensor's driver.
  using Changed = std::function<void(bool came, const std::string& uri)>;

  /// Loads OpenNI2. From then on, the working directory of the calling thread, and of threads that it starts, is
  /// separate from that of the process.
  static Result<std::unique_ptr<OpenNiLibrary>> load(Changed changed = {});
  ~OpenNiLibrary();
  OpenNiLibrary(const OpenNiLibrary&) = delete;
  OpenNiLibrary& operator=(const OpenNiLibrary&) = delete;

  /// The sensors that OpenNI2 lists now.
  std::vector<openni::DeviceInfo> sensors() const;

 private:
  class Listener : public openni::OpenNI::DeviceConnectedListener, public openni::OpenNI::DeviceDisconnectedListener {
   public:
    explicit Listener(Changed changed) : changed_(std::move(changed)) {}
    void onDeviceConnected(const openni::DeviceInfo* info) override { changed_(true, info->getUri()); }
    void onDeviceDisconnected(const openni::DeviceInfo* info) override { changed_(false, info->getUri()); }

   private:
    Changed changed_;
  };
  explicit OpenNiLibrary(std::unique_ptr<Listener> listener);

  std::unique_ptr<Listener> listener_;
};

/// OpenNI2's description of the last failure on this thread, without line breaks.
std::string openni_error();

}  // namespace barehand
