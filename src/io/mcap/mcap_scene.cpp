#include "io/mcap/mcap_scene.h"

#include "io/ros/ros_time.h"

namespace barehand::mcap {

Result<void> write_scene(McapWriter& file, const ros::Scene& scene) {
  const auto time = ros::time_of(scene.utime);
  if (!time) return tl::unexpected(time.error());
  std::vector<NewMessage> messages;
  for (ros::Topic& topic : ros::topics_of(scene)) {
    auto bytes = topic.encode();
    if (!bytes) return tl::unexpected(bytes.error());
    messages.push_back({std::move(topic.name), std::move(topic.type), std::move(topic.schema),
                        std::move(topic.metadata), std::move(*bytes)});
  }
  return file.write(messages, ros::nanoseconds(*time), static_cast<std::uint32_t>(scene.number));
}

}  // namespace barehand::mcap
