#include "io/web/foxglove_client.h"

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

FoxgloveClient::~FoxgloveClient() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  on_gone_(*this);
}

void FoxgloveClient::start() {
  replies_.add(text_of({{"op", "serverInfo"},
                        {"name", "barehand"},
                        {"capabilities", Json::array()},
                        {"supportedEncodings", Json::array()},
                        {"metadata", Json::object()}}));
  thread_ = std::thread([this] { run(); });
}

/// Adds and removes subscriptions. Answers each request that cannot be fulfilled with an error.
void FoxgloveClient::execute(const FoxgloveRequest& request) {
  for (const auto& [id, channel] : request.subscribe) {
    const std::string name = "Subscription " + std::to_string(id);
    if (channel == 0 || channel > advertised_)
      refuse(name + " asks for channel " + std::to_string(channel) +
             ", which does not exist. Give the id of a channel that was advertised.");
    else if (next_.subscriptions.contains(id))
      refuse(name + " exists already. Choose another id, or unsubscribe first.");
    else if (next_.subscriptions.size() >= kMostSubscriptions)
      refuse(name + " is one too many; a viewer may have " + std::to_string(kMostSubscriptions) + ".");
    else
      next_.subscriptions[id] = channel;
  }
  for (const std::uint32_t id : request.unsubscribe)
    if (next_.subscriptions.erase(id) == 0) refuse("Subscription " + std::to_string(id) + " does not exist.");
}

/// Sends the viewer an error status that says why its request was not fulfilled.
void FoxgloveClient::refuse(const std::string& why) {
  constexpr int kError = 2;  // level of a status
  replies_.add(text_of({{"op", "status"}, {"level", kError}, {"message", why}}));
}

bool FoxgloveClient::receive(std::string_view text) {
  const auto request = parse_foxglove_request(text);
  const std::lock_guard lock(mutex_);
  request ? execute(*request) : refuse(request.error().message());

  // Send the last frame again, so that new subscriptions get a message even if no frame follows (a paused log).
  if (request && !request->subscribe.empty()) frames_.repeat();
  changed_.notify_all();
  // After a farewell the client is still read, until it closes, so that it loses nothing of what was sent.
  return !broken_ || next_.farewell;
}

void FoxgloveClient::post(ViewFramePtr frame) {
  {
    const std::lock_guard lock(mutex_);
    if (ending_) return;
    frames_.post(std::move(frame));
  }
  changed_.notify_all();
}

void FoxgloveClient::end(const Farewell& farewell) {
  {
    const std::lock_guard lock(mutex_);
    next_.farewell = farewell;
  }
  changed_.notify_all();
}

QueueHealth FoxgloveClient::health() const {
  const std::lock_guard lock(mutex_);
  return frames_.health();
}

void FoxgloveClient::run() {
  Due due;
  while (wait(due)) {
    if (send(due)) continue;
    if (!due.farewell) socket_.disconnect();
    const std::lock_guard lock(mutex_);
    broken_ = true;
  }
}

/// Waits until something is to be sent, and moves it to `due`. Returns false when the client is being destroyed.
bool FoxgloveClient::wait(Due& due) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return ending_ || (!broken_ && has_due()); });
  if (ending_) return false;
  due.replies = replies_.take();
  due.farewell = next_.farewell;
  due.frame = frames_.take();
  due.subscriptions = next_.subscriptions;
  return true;
}

bool FoxgloveClient::send(const Due& due) {
  for (const std::string& reply : due.replies)
    if (!socket_.send_text(reply)) return false;
  if (due.frame && !send_frame(due)) return false;
  if (due.farewell) socket_.ask_to_close(*due.farewell);
  return !due.farewell;  // nothing may be sent after a request to close
}

bool FoxgloveClient::send_frame(const Due& due) {
  const auto time = ros::time_of(due.frame->content().utime);
  if (!time) return true;

  // Advertise the topics that are new to the viewer.
  const ros::Scene scene = scene_of(due.frame->content());
  const std::vector<ros::Topic> topics = ros::topics_of(scene);
  if (!advertise(topics)) return false;

  // Encode each topic to which the viewer has subscribed, once, and send it.
  for (const ros::Topic& topic : topics) {
    const std::uint32_t channel = channels_.at(topic.name);
    ros::Bytes message;

    // Send the message under the number of each subscription to the topic.
    for (const auto& [subscription, wanted] : due.subscriptions) {
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
