#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/clock.h"
#include "io/web/frame_client.h"

namespace barehand {

/// One client of the page's WebSocket. Frames are sent only after the client has sent its settings (ViewSettings), and
/// not faster than it wishes and acknowledges.
class ViewClient : public FrameClient {
 public:
  /// Called on threads of the server.
  struct Handlers {
    std::function<Result<void>(const PlayerCommand&)> play;
    std::function<Result<void>(const RecordCommand&)> record;
    OnGone gone;
  };
  /// `clock` must outlive the client.
  ViewClient(WebSocket socket, const Clock& clock, Handlers handlers);

 private:
  void execute(std::string_view text) override;
  Result<void> follow(const ViewRequest& request);
  void reply(const Error& error);
  std::optional<std::int64_t> delay_us() const override;
  std::size_t room() const override;
  void on_frame() override;
  bool send_frame(const ViewFrame& frame) override;
  void write_new_skins(const ViewFrame& frame);

  const Clock& clock_;
  const Handlers handlers_;

  // Protected by the mutex.
  std::optional<ViewSettings> settings_;  // none: the client has not sent them yet
  int under_way_ = 0;                     // number of frames that were sent and not acknowledged yet
  std::int64_t next_at_us_ = 0;           // earliest time of the next frame, steady clock

  // Used by the sending thread only.
  std::array<ViewSkinPtr, 2> skins_;  // the skins sent last, by Handedness
  std::array<std::int64_t, 2> skin_sent_us_{};
  std::vector<std::uint8_t> bytes_;
};

}  // namespace barehand
