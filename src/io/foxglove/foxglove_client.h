#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/foxglove/foxglove_request.h"
#include "io/ros/ros_topics.h"
#include "io/web/frame_client.h"

namespace barehand {

/// The names of the WebSocket subprotocol of FoxgloveClient; the protocol is the same under both.
inline constexpr const char* kFoxgloveProtocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

/// The connection to a viewer such as Foxglove or Lichtblick (https://github.com/foxglove/ws-protocol). A topic of
/// ros::topics_of() is advertised when it has its first message; the viewer gets the topics that it subscribes to, and
/// only those are encoded.
class FoxgloveClient : public FrameClient {
 public:
  FoxgloveClient(WebSocket socket, OnGone on_gone);

 private:
  void execute(std::string_view text) override;
  void change(const FoxgloveRequest& request);
  void refuse(const std::string& why);
  bool send_frame(const ViewFrame& frame) override;
  bool advertise(const std::vector<ros::Topic>& topics);
  bool send_message(std::uint32_t subscription, std::uint64_t time, std::span<const std::uint8_t> message);

  // Protected by the mutex.
  std::map<std::uint32_t, std::uint32_t> subscriptions_;  // channel by the viewer's subscription id
  std::uint32_t advertised_ = 0;                          // the viewer knows the channels 1 to this one

  // Used by the sending thread only.
  std::map<std::string, std::uint32_t> channels_;  // advertised channels by topic
  std::vector<std::uint8_t> bytes_;
};

}  // namespace barehand
