#include "drivers/openni2/usb_bus.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

namespace barehand {

std::string usb_bus_state(const std::string& folder) {
  std::vector<std::string> devices;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::string number;  // counts up with every plug
    std::ifstream(entry->path() / "devnum") >> number;
    devices.push_back(entry->path().filename().string() + "#" + number);
  }
  std::sort(devices.begin(), devices.end());
  std::string state;
  for (const std::string& device : devices) state += device + " ";
  return state;
}

}  // namespace barehand
