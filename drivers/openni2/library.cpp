// Loads and unloads OpenNI2, of which a process can have only one instance.
#include "drivers/openni2/library.h"

#include <sched.h>

#include <sstream>

namespace barehand {

std::string openni_error() {
  std::istringstream words(openni::OpenNI::getExtendedError());
  std::string text;
  for (std::string word; words >> word;) text += (text.empty() ? "" : " ") + word;
  return text.empty() ? "no reason given" : text;
}

Result<std::unique_ptr<OpenNiLibrary>> OpenNiLibrary::load(Changed changed) {
  // While OpenNI2 loads its drivers it changes into their folder and back, which must not affect other threads that
  // open relative paths meanwhile. If a container forbids the separation, they are affected.
  static_cast<void>(unshare(CLONE_FS));
  if (openni::OpenNI::initialize() != openni::STATUS_OK) {
    const std::string reason = openni_error();
    openni::OpenNI::shutdown();
    return fail("OpenNI2 cannot be initialised: " + reason, "OpenNI2",
                "its drivers must lie in OpenNI2/Drivers beside libOpenNI2.so.0: sudo apt-get install libopenni2-0");
  }
  return std::unique_ptr<OpenNiLibrary>(
      new OpenNiLibrary(changed ? std::make_unique<Listener>(std::move(changed)) : nullptr));
}

OpenNiLibrary::OpenNiLibrary(std::unique_ptr<Listener> listener) : listener_(std::move(listener)) {
  if (!listener_) return;
  openni::OpenNI::addDeviceConnectedListener(listener_.get());
  openni::OpenNI::addDeviceDisconnectedListener(listener_.get());
}

OpenNiLibrary::~OpenNiLibrary() {
  if (listener_) {
    openni::OpenNI::removeDeviceConnectedListener(listener_.get());
    openni::OpenNI::removeDeviceDisconnectedListener(listener_.get());
  }
  openni::OpenNI::shutdown();
}

std::vector<openni::DeviceInfo> OpenNiLibrary::sensors() const {
  openni::Array<openni::DeviceInfo> found;
  openni::OpenNI::enumerateDevices(&found);
  std::vector<openni::DeviceInfo> sensors;
  for (int i = 0; i < found.getSize(); ++i) sensors.push_back(found[i]);
  return sensors;
}

}  // namespace barehand
