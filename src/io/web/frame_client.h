#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "io/web/replies.h"
#include "io/web/waiting_frames.h"
#include "io/web/web_server.h"

namespace barehand {

using StatusText = std::shared_ptr<const std::string>;  ///< JSON

/// A client to which a thread of its own sends frames, statuses and answers. Of the frames that must wait for the
/// client only the newest is kept, and of the statuses too: a client that reads slowly or not at all delays no one
/// else.
class FrameClient : public WebPeer {
 public:
  /// Called on a thread of the server when the client is gone.
  using OnGone = std::function<void(FrameClient&)>;

  void start() final;
  bool receive(std::string_view text) final;
  void gone() final;
  /// Queues a frame and returns at once; may be called on any thread. Waiting frames for which the client has no room
  /// are dropped and counted.
  void post(ViewFramePtr frame);
  void post_status(StatusText status);
  /// Sends the data that are waiting, whether or not the client acknowledges them, and then asks the client to close
  /// the connection. Returns at once.
  void end(const Farewell& farewell);
  /// Whether the last status has been sent, or the connection is broken so that nothing can be sent.
  bool is_told() const;
  /// Counts the frames of this client.
  QueueHealth health() const;

 protected:
  FrameClient(WebSocket socket, OnGone on_gone) : socket_(socket), on_gone_(std::move(on_gone)) {}

  /// Executes a request of the client; called on a thread of the server.
  virtual void execute(std::string_view text) = 0;
  /// Sends a frame; called on the sending thread. Returns false if nothing more can be sent.
  virtual bool send_frame(const ViewFrame& frame) = 0;
  /// How long a frame must still wait before it may be sent [us]; none: until the client asks for it. Called with the
  /// mutex locked, and so are room() and on_frame().
  virtual std::optional<std::int64_t> delay_us() const { return 0; }
  /// How many frames may be sent at once, without waiting for the client or for time to pass.
  virtual std::size_t room() const { return WaitingFrames::kMost; }
  /// Called when a frame is taken to be sent.
  virtual void on_frame() {}
  /// Whether no more frames will come, so that the last one need not wait for acknowledgements.
  bool is_ending() const { return farewell_.has_value(); }

  WebSocket socket_;
  mutable std::mutex mutex_;  // protects the members below, except for the thread
  WaitingFrames frames_;
  Replies replies_;

 private:
  /// Data to be sent next.
  struct Due {
    ViewFramePtr frame;
    StatusText status;
    std::vector<std::string> replies;
    std::optional<Farewell> farewell;
  };
  void run();
  bool wait(Due& due);
  std::optional<std::int64_t> frame_delay_us() const;
  bool has_due() const;
  bool send(const Due& due);

  const OnGone on_gone_;
  std::condition_variable changed_;
  StatusText status_;
  std::optional<Farewell> farewell_;
  bool sending_ = false, gone_ = false;
  bool broken_ = false;  // nothing more can be sent
  std::thread thread_;
};

}  // namespace barehand
