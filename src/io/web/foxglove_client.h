#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/statistics.h"
#include "io/ros/ros_topics.h"
#include "io/web/foxglove_request.h"
#include "io/web/view_frame.h"
#include "io/web/web_server.h"

namespace barehand {

/// The names under which viewers ask for the protocol of FoxgloveClient, which is the same under both.
inline constexpr const char* kFoxgloveProtocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

/// A viewer such as Foxglove or Lichtblick (https://github.com/foxglove/ws-protocol): it is told of the topics of
/// ros::topics_of as soon as they have something to say, and gets those that it subscribes to. It keeps the newest
/// frame that was not sent yet, and nothing behind it. Messages are made and sent on a thread of its own, and only
/// those that it wants.
class FoxgloveClient : public WebPeer {
 public:
  using OnGone = std::function<void(const FoxgloveClient&)>;
  /// `on_gone` is called on a thread of the server, while the client is being destroyed.
  FoxgloveClient(WebSocket socket, OnGone on_gone) : socket_(socket), on_gone_(std::move(on_gone)) {}
  ~FoxgloveClient() override;

  void start() override;
  bool hear(std::string_view text) override;
  /// Any thread, at once. A frame that waits is replaced and counted as dropped.
  void post(ViewFramePtr frame);
  /// Frames of this client; a capacity of one.
  QueueHealth health() const;

 private:
  using Subscriptions = std::map<std::uint32_t, std::uint32_t>;  ///< channel by the client's own number
  /// What is to be sent next.
  struct Due {
    ViewFramePtr frame;
    std::string reply;
    Subscriptions subscriptions;
  };
  Result<void> obey(const FoxgloveRequest& request);
  void run();
  bool wait(Due& due);
  bool send(const Due& due);
  bool advertise(const std::vector<ros::Topic>& topics);
  bool send_message(std::uint32_t subscription, std::uint64_t time, std::span<const std::uint8_t> message);

  WebSocket socket_;
  const OnGone on_gone_;

  mutable std::mutex mutex_;  // protects the members down to the blank line
  std::condition_variable changed_;
  Due next_;
  ViewFramePtr sent_;  // the last one
  std::int64_t pushed_ = 0, popped_ = 0, dropped_ = 0;
  bool ending_ = false, broken_ = false;

  std::map<std::string, std::uint32_t> channels_;  // told of, by topic; sender's thread only, like the next one
  std::vector<std::uint8_t> bytes_;
  std::thread thread_;
};

}  // namespace barehand
