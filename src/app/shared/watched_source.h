#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "app/shared/depth_range.h"
#include "core/clock.h"
#include "core/repeat_filter.h"
#include "sensor/frame_source.h"

namespace barehand {

/// Stands between a source, of whatever kind, and whoever takes its frames, and says what looks wrong about them:
/// colour that is left out, intrinsics that no camera has, depth out of range, a picture that stands still, noise. Of a
/// live source pictures that stand still or are noise are skipped; a recording's are its own, and may be rendered.
class WatchedSource : public FrameSource {
 public:
  /// `clock` outlives it.
  WatchedSource(std::unique_ptr<FrameSource> source, const DepthLimits& limits, const Clock& clock);

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return source_->live(); }
  std::string name() const override { return source_->name(); }
  std::vector<QueueHealth> queues() const override { return source_->queues(); }

 private:
  bool look(const FramePtr& frame);
  void look_at_camera(const RgbdFrame& frame);
  bool look_at_picture(const FramePtr& frame);
  void look_at_stillness(const RgbdFrame& frame, bool still);
  void say(const std::string& kind, const std::string& what, const std::string& remedy = "");
  SourceEvent take_next();

  std::unique_ptr<FrameSource> source_;
  const DepthLimits limits_;
  RepeatFilter filter_;
  std::optional<DepthRange> range_;  ///< of the camera in force; none: no frame came
  FramePtr before_;
  FramePtr still_since_;  ///< first of a run of frames with the same depth image; null: none
  int still_frames_ = 0;
  std::deque<SourceEvent> to_come_;  ///< before anything new is read
};

}  // namespace barehand
