#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "io/ros/ros_topics.h"
#include "io/web/foxglove_request.h"
#include "io/web/newest_frame.h"
#include "io/web/replies.h"
#include "io/web/web_server.h"

namespace barehand {

/// The names of the WebSocket subprotocol of FoxgloveClient; the protocol is the same under both.
inline constexpr const char* kFoxgloveProtocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

/// The connection to a viewer such as Foxglove or Lichtblick (https://github.com/foxglove/ws-protocol). A topic of
/// ros::topics_of() is advertised when it has its first message; the viewer gets the topics that it subscribes to. Of
/// the frames that were not sent yet, only the newest is kept. Messages are encoded and sent on the client's own
/// thread, and only those that are subscribed to.
class FoxgloveClient : public WebPeer {
 public:
  using OnGone = std::function<void(const FoxgloveClient&)>;
  /// `on_gone` is called on a thread of the server while the client is being destroyed.
  FoxgloveClient(WebSocket socket, OnGone on_gone) : socket_(socket), on_gone_(std::move(on_gone)) {}
  ~FoxgloveClient() override;

  void start() override;
  bool receive(std::string_view text) override;
  /// Queues a frame and returns at once; may be called on any thread. A waiting frame is replaced and counted as
  /// dropped.
  void post(ViewFramePtr frame);
  /// Sends what still waits, and then asks the viewer to close the connection. Returns at once.
  void end(const Farewell& farewell);
  /// The counts of this client's frames, like those of a queue that holds one frame.
  QueueHealth health() const;

 private:
  using Subscriptions = std::map<std::uint32_t, std::uint32_t>;  ///< channel by the viewer's subscription id
  /// Data to be sent next.
  struct Due {
    ViewFramePtr frame;
    std::vector<std::string> replies;
    Subscriptions subscriptions;
    std::optional<Farewell> farewell;
  };
  void execute(const FoxgloveRequest& request);
  void refuse(const std::string& why);
  bool has_due() const { return frames_.waiting() || !replies_.empty() || next_.farewell; }
  void run();
  bool wait(Due& due);
  bool send(const Due& due);
  bool send_frame(const Due& due);
  bool advertise(const std::vector<ros::Topic>& topics);
  bool send_message(std::uint32_t subscription, std::uint64_t time, std::span<const std::uint8_t> message);

  WebSocket socket_;
  const OnGone on_gone_;

  mutable std::mutex mutex_;  // protects the members down to the blank line
  std::condition_variable changed_;
  Due next_;  // data to be sent next, except for the frame and the replies, which are in frames_ and replies_
  NewestFrame frames_;
  Replies replies_;
  std::uint32_t advertised_ = 0;  // the viewer knows the channels 1 to this one
  bool ending_ = false;
  bool broken_ = false;  // nothing more can be sent

  // Used by the sending thread only.
  std::map<std::string, std::uint32_t> channels_;  // advertised channels by topic
  std::vector<std::uint8_t> bytes_;
  std::thread thread_;
};

}  // namespace barehand
