#include "drivers/openni2/usb_address.h"

#include <cinttypes>
#include <cstdio>

namespace barehand {

std::optional<UsbAddress> usb_address(const std::string& uri) {
  UsbAddress address;
  int end = 0;
  const int read = std::sscanf(uri.c_str(), "%4" SCNx16 "/%4" SCNx16 "@%3d/%3d%n", &address.vendor, &address.product,
                               &address.bus, &address.number, &end);
  if (read != 4 || static_cast<std::size_t>(end) != uri.size()) return std::nullopt;
  return address;
}

}  // namespace barehand
