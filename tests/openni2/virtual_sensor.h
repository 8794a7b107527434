#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <thread>

#include "support/temp_folder.h"

namespace barehand {

/// Controls the virtual OpenNI2 device (virtual_device/settings.h) in this process and in child processes, by a file of
/// settings. Only one object may exist at a time, and it must be created before OpenNI2 starts.
class VirtualSensor {
 public:
  using Settings = std::map<std::string, std::string>;

  explicit VirtualSensor(Settings settings = {}) : settings_(std::move(settings)) {
    write();
    setenv("BAREHAND_VIRTUAL_OPENNI2", path_.c_str(), 1);
    setenv("LD_LIBRARY_PATH", BAREHAND_OPENNI2_SDK, 1);
    // Wait until a driver that an earlier test left loaded has read the file.
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  ~VirtualSensor() { unsetenv("BAREHAND_VIRTUAL_OPENNI2"); }

  /// Changes settings. They are applied within a few hundredths of a second.
  void set(const Settings& changes) {
    for (const auto& [key, value] : changes) settings_[key] = value;
    write();
  }
  void unplug() { set({{"plugged", "0"}}); }
  void plug() { set({{"plugged", "1"}}); }

 private:
  void write() const {
    const std::string draft = path_ + ".draft";
    {
      std::ofstream file(draft);
      for (const auto& [key, value] : settings_) file << key << "=" << value << "\n";
    }
    std::rename(draft.c_str(), path_.c_str());  // so that the driver never reads a half-written file
  }

  test::TempFolder folder_;
  const std::string path_ = folder_.path() + "/control";
  Settings settings_;
};

}  // namespace barehand
