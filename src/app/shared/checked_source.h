#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "app/shared/depth_range.h"
#include "core/clock.h"
#include "core/repeat_filter.h"
#include "sensor/frame_source.h"

namespace barehand {

/// Passes on the frames of another source and reports what looks wrong in them: colour that was left out, intrinsics
/// that no camera has, depth out of range, an image that does not change, noise. Frames of a live source whose image
/// does not change or is noise are skipped. Those of a recording are kept, since they may be rendered.
class CheckedSource : public FrameSource {
 public:
  /// `clock` must outlive the source.
  CheckedSource(std::unique_ptr<FrameSource> source, const DepthLimits& limits, const Clock& clock);

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return source_->live(); }
  std::string name() const override { return source_->name(); }
  std::vector<QueueHealth> queues() const override { return source_->queues(); }

 private:
  bool check_frame(const FramePtr& frame);
  void check_camera(const RgbdFrame& frame);
  bool check_image(const FramePtr& frame);
  void check_stillness(const RgbdFrame& frame, bool still);
  void say(const std::string& kind, const std::string& what, const std::string& remedy = "");
  SourceEvent take_next();

  std::unique_ptr<FrameSource> source_;
  const DepthLimits limits_;
  RepeatFilter filter_;
  std::optional<DepthRange> range_;  ///< check of the current camera; none before the first frame
  FramePtr before_;
  FramePtr still_since_;  ///< first of a run of frames with the same depth image; null: the image changes
  int still_frames_ = 0;
  std::deque<SourceEvent> to_come_;  ///< events to deliver before another frame is read
};

}  // namespace barehand
