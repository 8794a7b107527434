#pragma once

#include "core/error.h"
#include "io/ros/ros_types.h"

namespace barehand::ros {

/// Converts microseconds since the epoch to ROS time. Error: before 1901 or after 2038, which ROS cannot express.
inline Result<Time> time_of(std::int64_t utime) {
  const std::int64_t second = 1'000'000;
  const std::int64_t part = (utime % second + second) % second, whole = (utime - part) / second;
  if (whole < INT32_MIN || whole > INT32_MAX)
    return fail("the time stamp " + std::to_string(utime) + " us lies beyond what ROS messages can hold", "",
                "use an LCM log or a folder");
  return Time{static_cast<std::int32_t>(whole), static_cast<std::uint32_t>(part * 1000)};
}

/// Converts ROS time to microseconds since the epoch, rounded down.
inline std::int64_t utime_of(const Time& time) { return std::int64_t{time.sec} * 1'000'000 + time.nanosec / 1000; }

/// Nanoseconds since the epoch, the unit of MCAP and the viewers; 0 for times before the epoch.
inline std::uint64_t nanoseconds(const Time& time) {
  return time.sec < 0 ? 0 : static_cast<std::uint64_t>(time.sec) * 1'000'000'000 + time.nanosec;
}

}  // namespace barehand::ros
