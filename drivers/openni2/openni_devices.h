#pragma once

#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// A sensor as OpenNI2 lists it.
struct OpenNiDevice {
  std::string uri, vendor, name;
};

/// Error: OpenNI2 does not start.
Result<std::vector<OpenNiDevice>> list_openni_devices();
/// "2.2.0.33".
std::string openni_version();

}  // namespace barehand
