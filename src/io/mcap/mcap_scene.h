#pragma once

#include "io/mcap/mcap_writer.h"
#include "io/ros/ros_topics.h"

namespace barehand::mcap {

/// Writes all that a scene says, under its time and with its number. Errors: those of the file, and a time that ROS
/// cannot express.
Result<void> write_scene(McapWriter& file, const ros::Scene& scene);

}  // namespace barehand::mcap
