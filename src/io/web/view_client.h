#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/clock.h"
#include "io/web/newest_frame.h"
#include "io/web/replies.h"
#include "io/web/web_server.h"

namespace barehand {

using StatusText = std::shared_ptr<const std::string>;  ///< JSON

/// One client of the page's WebSocket. Of the frames that were not sent yet, only the newest is kept. Data are sent on
/// the client's own thread; frames are sent only after the client has sent its settings (ViewSettings). A client that
/// reads slowly or not at all gets fewer frames and delays no one else.
class ViewClient : public WebPeer {
 public:
  /// Called on threads of the server; `gone` is called while the client is being destroyed.
  struct Handlers {
    std::function<void(const PlayerCommand&)> play;
    std::function<Result<void>(const RecordCommand&)> record;
    std::function<void(const ViewClient&)> gone;
  };
  /// `clock` must outlive the client.
  ViewClient(WebSocket socket, const Clock& clock, Handlers handlers);
  ~ViewClient() override;

  void start() override;
  bool receive(std::string_view text) override;
  /// Queues a frame and returns at once; may be called on any thread. A waiting frame is replaced and counted as
  /// dropped.
  void post(ViewFramePtr frame);
  void post_status(StatusText status);
  /// Sends the data that are waiting, whether or not the client acknowledges them, and then asks the client to close
  /// the connection. Returns at once.
  void end(const Farewell& farewell);
  /// Whether the last status has been sent, or the connection is broken so that nothing can be sent.
  bool is_told() const;
  /// Counts the frames of this client, as of a queue with a capacity of one.
  QueueHealth health() const;

 private:
  /// Data to be sent next.
  struct Due {
    ViewFramePtr frame;
    StatusText status;
    std::vector<std::string> replies;
    ViewSettings settings;
    std::optional<Farewell> farewell;
  };
  Result<void> follow(const ViewRequest& request);
  void reply(const Error& error);
  void run();
  bool wait(Due& due);
  bool has_due(std::int64_t now_us) const;
  bool has_due_frame(std::int64_t now_us) const;
  bool send(const Due& due);
  bool send_frame(const ViewFrame& frame, const ViewSettings& settings);
  void write_new_skins(const ViewFrame& frame);

  WebSocket socket_;
  const Clock& clock_;
  const Handlers handlers_;

  mutable std::mutex mutex_;  // protects the members down to the blank line
  std::condition_variable changed_;
  Due next_;  // data to be sent next, without the frame and the replies, which are in frames_ and replies_
  NewestFrame frames_;
  Replies replies_;
  int under_way_ = 0;            // number of frames that were sent and not acknowledged yet
  std::int64_t next_at_us_ = 0;  // earliest time of the next frame, steady clock
  bool asked_ = false, sending_ = false, ending_ = false;
  bool broken_ = false;  // nothing more can be sent

  // Used by the sending thread only.
  std::array<ViewSkinPtr, 2> skins_;  // the skins sent last, by Handedness
  std::array<std::int64_t, 2> skin_sent_us_{};
  std::vector<std::uint8_t> bytes_;
  std::thread thread_;
};

}  // namespace barehand
