#pragma once

#include <chrono>
#include <optional>

#include "app/view/frame_messages.h"
#include "core/clock.h"
#include "core/queue.h"
#include "drivers/lcm/lcm_listener.h"
#include "io/web/view_server.h"

namespace barehand {

/// Shows what trackers send on an LCM network. Messages with the same time stamp belong to one frame.
class LiveView {
 public:
  struct Options {
    std::string prefix;                      ///< prefix of the tracker's channels
    std::optional<SE3> T_world_camera = {};  ///< none: the camera's pose in the room is unknown
    LogRecorder* recorder = nullptr;         ///< null: nothing can be recorded. Must outlive the view
  };
  /// `server` and `clock` must outlive the view.
  LiveView(std::shared_ptr<LcmBus> bus, Options options, ShownHands hands, ViewServer& server, const Clock& clock);
  /// Waits at most `patience` for a message, and shows the current frame if it is complete.
  void step(std::chrono::milliseconds patience);
  bool broken() const { return listener_.broken(); }

 private:
  void take(ReceivedMessage message);
  void record(const ReceivedMessage& message, MessageKind kind);
  void keep_image(ReceivedMessage message);
  void show_gathered();
  void show_status();

  const Options options_;
  const std::string name_;
  ShownHands hands_;
  SteadyRange depths_;
  ViewServer& server_;
  const Clock& clock_;
  std::vector<ReceivedMessage> gathered_;  // messages of one frame, without its image
  std::vector<ReceivedMessage> images_;    // the latest images, oldest first; states arrive after their image
  std::optional<PipelineHealth> health_;
  std::int64_t frame_us_, status_us_ = 0, gathered_us_ = 0;  // times by the steady clock [us]
  BoundedQueue<ReceivedMessage> queue_{"LCM", 64, Overflow::drop_oldest};
  LcmListener listener_;  // declared last: its thread fills the queue
};

}  // namespace barehand
