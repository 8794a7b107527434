#include "io/foxglove/foxglove_client.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "io/ros/ros_time.h"

namespace barehand {

// The connection to one viewer that speaks Foxglove's WebSocket protocol: answers its requests and sends it the frames'
// topics as ROS messages.

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostSubscriptions = 256;  // subscriptions of one client; there are about a dozen topics
constexpr int kJpegQuality = 85;                 // lossy, since viewers only display the colour

/// JSON as text. Strings that are not UTF-8, such as parts of a client's message, are repaired.
std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// The ROS scene of a frame. `content` must outlive the scene.
ros::Scene scene_of(const ViewFrame::Content& content) {
  ros::Scene scene;
  scene.utime = content.utime;
  scene.number = content.number;
  scene.frame = content.frame;
  scene.hands = content.hands;
  scene.objects = content.objects;
  scene.health = content.health;
  scene.T_world_camera = content.T_world_camera;
  scene.jpeg_quality = kJpegQuality;
  return scene;
}

}  // namespace

FoxgloveClient::FoxgloveClient(WebSocket socket, OnGone on_gone) : FrameClient(socket, std::move(on_gone)) {
  replies_.add(text_of({{"op", "serverInfo"},
                        {"name", "barehand"},
                        {"capabilities", Json::array()},
                        {"supportedEncodings", Json::array()},
                        {"metadata", Json::object()}}));
}

void FoxgloveClient::execute(std::string_view text) {
  const auto request = parse_foxglove_request(text);
  const std::lock_guard lock(mutex_);
  request ? change(*request) : refuse(request.error().message());

  // Send the last frame again, so that new subscriptions get a message even if no frame follows (a paused log).
  if (request && !request->subscribe.empty()) frames_.repeat();
}

/// Adds and removes subscriptions. Answers each request that cannot be fulfilled with an error.
void FoxgloveClient::change(const FoxgloveRequest& request) {
  for (const auto& [id, channel] : request.subscribe) {
    const std::string name = "Subscription " + std::to_string(id);
    if (channel == 0 || channel > advertised_)
      refuse(name + " asks for channel " + std::to_string(channel) +
             ", which does not exist. Give the id of a channel that was advertised.");
    else if (subscriptions_.contains(id))
      refuse(name + " exists already. Choose another id, or unsubscribe first.");
    else if (subscriptions_.size() >= kMostSubscriptions)
      refuse(name + " is one too many; a viewer may have " + std::to_string(kMostSubscriptions) + ".");
    else
      subscriptions_[id] = channel;
  }
  for (const std::uint32_t id : request.unsubscribe)
    if (subscriptions_.erase(id) == 0) refuse("Subscription " + std::to_string(id) + " does not exist.");
}

/// Sends the viewer an error status that says why its request was not fulfilled.
void FoxgloveClient::refuse(const std::string& why) {
  constexpr int kError = 2;  // level of a status
  replies_.add(text_of({{"op", "status"}, {"level", kError}, {"message", why}}));
}

bool FoxgloveClient::send_frame(const ViewFrame& frame) {
  const auto time = ros::time_of(frame.content().utime);
  if (!time) return true;

  // Advertise the topics that are new to the viewer.
  const ros::Scene scene = scene_of(frame.content());
  const std::vector<ros::Topic> topics = ros::topics_of(scene);
  if (!advertise(topics)) return false;

  const auto subscriptions = [&] {
    const std::lock_guard lock(mutex_);
    return subscriptions_;
  }();

  // Encode each topic to which the viewer has subscribed, once, and send it.
  for (const ros::Topic& topic : topics) {
    const std::uint32_t channel = channels_.at(topic.name);
    ros::Bytes message;

    // Send the message under the number of each subscription to the topic.
    for (const auto& [subscription, wanted] : subscriptions) {
      if (wanted != channel) continue;
      if (message.empty()) message = topic.encode().value_or(ros::Bytes());
      if (!message.empty() && !send_message(subscription, ros::nanoseconds(*time), message)) return false;
    }
  }
  return true;
}

/// Advertises the topics that are new to the viewer.
bool FoxgloveClient::advertise(const std::vector<ros::Topic>& topics) {
  Json channels = Json::array();
  for (const ros::Topic& topic : topics) {
    const auto [known, added] = channels_.try_emplace(topic.name, static_cast<std::uint32_t>(channels_.size() + 1));
    if (added)
      channels.push_back({{"id", known->second},
                          {"topic", topic.name},
                          {"encoding", "cdr"},
                          {"schemaName", topic.type},
                          {"schemaEncoding", "ros2msg"},
                          {"schema", topic.schema}});
  }
  if (channels.empty()) return true;

  // Count the new channels before they are advertised, since the viewer may subscribe to them at once.
  {
    const std::lock_guard lock(mutex_);
    advertised_ = static_cast<std::uint32_t>(channels_.size());
  }
  return socket_.send_text(text_of({{"op", "advertise"}, {"channels", channels}}));
}

bool FoxgloveClient::send_message(std::uint32_t subscription, std::uint64_t time,
                                  std::span<const std::uint8_t> message) {
  bytes_.assign(1, 1);  // opcode "message data"
  for (const auto& [value, size] : {std::pair<std::uint64_t, int>(subscription, 4), {time, 8}})
    for (int i = 0; i < size; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> 8 * i));
  bytes_.insert(bytes_.end(), message.begin(), message.end());
  return socket_.send_binary(bytes_);
}

}  // namespace barehand
