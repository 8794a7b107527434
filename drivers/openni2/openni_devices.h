#pragma once

#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// A sensor as OpenNI2 lists it.
struct OpenNiDevice {
  std::string uri, vendor, name;
};

/// The sensors that OpenNI2 finds. Error: OpenNI2 does not start.
Result<std::vector<OpenNiDevice>> list_openni_devices();
/// The version of OpenNI2, such as "2.2.0.33".
std::string openni_version();

}  // namespace barehand
