#pragma once

#include <functional>
#include <string>
#include <vector>

#include "observe/egl/graphics_device.h"

namespace barehand {

// The checks of `barehand doctor`, which finds out whether tracking will work on this machine.

/// The result of one check of the machine.
struct Finding {
  enum class Level {
    ok,
    note,     ///< something optional is missing
    warning,  ///< tracking or publishing works, but badly
    problem,  ///< tracking or publishing will fail
  };
  Level level = Level::ok;
  std::string subject, text;
  std::string remedy;  ///< "": nothing to do
};

/// Runs all checks, in the order in which the problems should be fixed; `report` gets each finding as soon as it is
/// made.
void examine(const std::string& lcm_url, const std::function<void(const Finding&)>& report);

Finding check_processor();
std::vector<Finding> check_files();
/// Checks how much the kernel can buffer for LCM. `rmem_max_file`: the file in which the kernel states the size of the
/// largest receive buffer.
Finding check_receive_buffer(const std::string& lcm_url,
                             const std::string& rmem_max_file = "/proc/sys/net/core/rmem_max");
/// Checks that there is a route for LCM's multicast messages. `route_file` has the format of /proc/net/route.
Finding check_multicast_route(const std::string& lcm_url, const std::string& route_file = "/proc/net/route");
/// Sends messages of a frame's size over LCM, and counts how many come back.
Finding check_lcm(const std::string& lcm_url);
/// Checks whether a graphics device can compare samples instead of the CPU (key `observer` of the configuration), and
/// which of the two is faster.
Finding check_graphics(const std::string& egl_library = kEglLibrary);
/// Reports the version of OpenNI2, and the sensors that it finds.
std::vector<Finding> check_openni();
/// Reports port, speed and permission of the known depth sensors on the USB bus.
std::vector<Finding> check_usb();

}  // namespace barehand
