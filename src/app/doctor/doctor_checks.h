#pragma once

#include <functional>
#include <string>
#include <vector>

#include "observe/egl/graphics_device.h"

namespace barehand {

/// What one look at the machine showed.
struct Finding {
  enum class Level {
    ok,
    note,     ///< something optional is absent
    warning,  ///< works, but badly
    problem,  ///< tracking or publishing will fail
  };
  Level level = Level::ok;
  std::string subject, text;
  std::string remedy;  ///< "": nothing to do
};

/// All checks, in the order in which to mend what they find; `report` gets each finding as it is made.
void examine(const std::string& lcm_url, const std::function<void(const Finding&)>& report);

Finding check_processor();
std::vector<Finding> check_files();
/// `rmem_max_file`: where the kernel tells the largest receive buffer.
Finding check_receive_buffer(const std::string& lcm_url,
                             const std::string& rmem_max_file = "/proc/sys/net/core/rmem_max");
/// Routes as in /proc/net/route.
Finding check_multicast_route(const std::string& lcm_url, const std::string& route_file = "/proc/net/route");
/// Sends messages of a frame's size to itself.
Finding check_lcm(const std::string& lcm_url);
/// What the samples could be compared on besides the CPU (observer in the configuration).
Finding check_graphics(const std::string& egl_library = kEglLibrary);
/// OpenNI2 and the sensors that it sees.
std::vector<Finding> check_openni();
/// The known depth sensors on the USB bus: port, speed, permission.
std::vector<Finding> check_usb();

}  // namespace barehand
