#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/clock.h"
#include "core/slot.h"
#include "io/web/view_server.h"
#include "io/web/view_status.h"
#include "pipeline/sink.h"
#include "stages/publish/hand_messages.h"

namespace barehand {

/// --view: hands every frame, with the messages that the bus gets, to the live page, while somebody looks.
class ViewSink : public Sink {
 public:
  struct Input {
    std::string source;  ///< FrameSource::name()
    bool live = false;   ///< FrameSource::live()
    std::function<PipelineHealth()> health;
  };
  /// `server`, `clock` and `news` (may be null; looked at before every frame) outlive the sink.
  ViewSink(const PublishParams& params, ViewServer& server, Input input, const Clock& clock,
           Slot<PublishParams>* news = nullptr);

  std::string name() const override { return "view"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  /// The status goes on without frames.
  Result<void> idle() override;

 private:
  std::vector<HandMessages> make_messages(const TrackedFrame& tracked);
  ViewFramePtr make_frame(const TrackedFrame& tracked, const std::vector<HandMessages>& hands);
  ViewSkinPtr skin_of(const HandEstimate& estimate);
  void show_status();

  PublishParams params_;
  ViewServer& server_;
  const Input input_;
  const Clock& clock_;
  Slot<PublishParams>* news_;
  std::vector<HandMessageMaker> makers_;       // one a hand
  std::array<ViewSkinPtr, 2> skins_;           // by Handedness, of the last profiles
  std::int64_t frame_us_ = 0, status_us_ = 0;  // of the last frame, of the last status; steady clock
  bool any_frame_ = false;
};

}  // namespace barehand
