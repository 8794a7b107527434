#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/clock.h"
#include "core/slot.h"
#include "io/web/view_server.h"
#include "io/web/view_status.h"
#include "pipeline/sink.h"
#include "stages/publish/hand_messages.h"

namespace barehand {

/// --view: hands every frame, with the messages that the bus gets, to the live page, while somebody looks, and to the
/// recorder, while it records.
class ViewSink : public Sink {
 public:
  struct Input {
    std::string source;  ///< FrameSource::name()
    bool live = false;   ///< FrameSource::live()
    std::function<PipelineHealth()> health;
    std::optional<SE3> T_world_camera = {};  ///< none: the room is not known
    std::function<ViewScan()> scan = {};     ///< empty: no hand is being scanned
    std::string prefix = {};                 ///< of the channels in recordings
    LogRecorder* recorder = nullptr;         ///< null: nothing can be recorded. Outlives the sink
  };
  /// `server`, `clock` and `pending` (may be null; looked at before every frame) outlive the sink.
  ViewSink(const PublishParams& params, ViewServer& server, Input input, const Clock& clock,
           Slot<PublishParams>* pending = nullptr);

  std::string name() const override { return "view"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  /// The status goes on without frames.
  Result<void> idle() override;
  /// A recording is whole when it returns.
  Result<void> finish() override;

 private:
  std::vector<HandMessages> make_messages(const TrackedFrame& tracked);
  ViewFramePtr make_frame(const TrackedFrame& tracked, const std::vector<HandMessages>& hands);
  bool recording_changed() const;
  ViewSkinPtr skin_of(const HandEstimate& estimate);
  void show_status();

  PublishParams params_;
  ViewServer& server_;
  const Input input_;
  const Clock& clock_;
  Slot<PublishParams>* pending_;
  std::vector<HandMessageMaker> makers_;       // one a hand
  std::array<ViewSkinPtr, 2> skins_;           // by Handedness, of the last profiles
  std::int64_t frame_us_ = 0, status_us_ = 0;  // of the last frame, of the last status; steady clock
  bool any_frame_ = false;
  bool told_recording_ = false;  // by the last status
};

}  // namespace barehand
