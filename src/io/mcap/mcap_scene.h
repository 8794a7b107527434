#pragma once

#include "io/mcap/mcap_writer.h"
#include "io/ros/ros_topics.h"

namespace barehand::mcap {

/// Writes all messages of a scene, with its time stamp and its frame number as the sequence number, and the LCM
/// messages of its hands on topics below /lcm, for MessageLog. Errors: the file cannot be written, or ROS cannot
/// express the time.
Result<void> write_scene(McapWriter& file, const ros::Scene& scene);

}  // namespace barehand::mcap
