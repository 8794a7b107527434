#include "drivers/openni2/openni_devices.h"

#include "drivers/openni2/library.h"

namespace barehand {

Result<std::vector<OpenNiDevice>> list_openni_devices() {
  auto library = OpenNiLibrary::load();
  if (!library) return tl::unexpected(library.error());
  std::vector<OpenNiDevice> devices;
  for (const openni::DeviceInfo& info : (*library)->sensors())
    devices.push_back({info.getUri(), info.getVendor(), info.getName()});
  return devices;
}

std::string openni_version() {
  const openni::Version version = openni::OpenNI::getVersion();
  return std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
         std::to_string(version.maintenance) + "." + std::to_string(version.build);
}

}  // namespace barehand
