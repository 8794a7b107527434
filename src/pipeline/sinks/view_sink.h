#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "core/clock.h"
#include "io/web/view_server.h"
#include "io/web/view_status.h"
#include "pipeline/sink.h"
#include "pipeline/sinks/hand_message_makers.h"

namespace barehand {

/// --view: passes every frame, with the messages that go to the bus, to the server of the live page while the page is
/// open in a browser, and to the recorder while it records.
class ViewSink : public Sink {
 public:
  struct Input {
    std::string source;  ///< FrameSource::name()
    bool live = false;   ///< FrameSource::live()
    std::function<PipelineHealth()> health;
    std::optional<SE3> T_world_camera = {};  ///< none: the camera's pose in the room is unknown
    std::function<ViewScan()> scan = {};     ///< empty: no hand is being scanned
    std::string prefix = {};                 ///< prefix of the channels in recordings
    LogRecorder* recorder = nullptr;         ///< must outlive the sink; null: nothing can be recorded
    std::string if_silent = {};              ///< what the user should check if the source sends nothing, as a sentence
    /// What holds up the tracker at present, as a sentence; returns "" while nothing does. Empty: nothing ever does.
    std::function<std::string()> held_up_by = {};
  };
  /// `server`, `clock` and `pending` (changed parameters, taken before every frame; may be null) must outlive the sink.
  ViewSink(const PublishParams& params, ViewServer& server, Input input, const Clock& clock,
           Slot<PublishParams>* pending = nullptr);

  std::string name() const override { return "view"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  /// Sends the status even if no frames arrive.
  Result<void> idle() override;
  /// Ends a recording, waits until its file is complete, and sends the last status.
  Result<void> finish() override;

 private:
  ViewFramePtr make_frame(const TrackedFrame& tracked, const FrameMessages& messages);
  bool recording_changed() const;
  ViewSkinPtr skin_of(const HandEstimate& estimate);
  std::string trouble(const PipelineHealth& health) const;
  void show_status();

  HandMessageMakers makers_;
  ViewServer& server_;
  const Input input_;
  const Clock& clock_;
  std::array<ViewSkinPtr, 2> skins_;  // skins of the last profiles, indexed by Handedness
  SteadyRange depths_;
  std::int64_t frame_us_ = 0, status_us_ = 0;  // times of the last frame and of the last status; steady clock
  bool any_frame_ = false;
  bool shown_recording_ = false;  // whether the last status reported a recording in progress
};

}  // namespace barehand
