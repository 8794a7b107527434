#include "io/mcap/mcap_scene.h"

#include "io/ros/ros_time.h"

namespace barehand::mcap {

Result<void> write_scene(McapWriter& file, const ros::Scene& scene) {
  const auto time = ros::time_of(scene.utime);
  if (!time) return tl::unexpected(time.error());

  // The topics for viewers.
  std::vector<NewMessage> messages;
  for (ros::Topic& topic : ros::topics_of(scene)) {
    auto bytes = topic.encode();
    if (!bytes) return tl::unexpected(bytes.error());
    messages.push_back({std::move(topic.name), std::move(topic.type), std::move(topic.schema),
                        std::move(topic.metadata), std::move(*bytes)});
  }

  // The messages of the LCM network, from which hands and objects can be read back whole.
  static const std::string type = ros::schema_name<ros::LcmMessage>(), schema = ros::SchemaText::of<ros::LcmMessage>();
  const auto add = [&](const ros::LcmMessage& message) {
    messages.push_back({"/lcm/" + message.channel, type, schema, {}, ros::encode(message)});
  };
  for (const ros::HandState& hand : scene.hands)
    for (const ros::LcmMessage& message : ros::lcm_messages(hand)) add(message);
  for (const object_state_t& object : scene.objects) add(ros::lcm_message(object));
  return file.write(messages, ros::nanoseconds(*time), static_cast<std::uint32_t>(scene.number));
}

}  // namespace barehand::mcap
