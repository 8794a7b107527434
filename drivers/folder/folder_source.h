#pragma once

#include <memory>
#include <optional>
#include <string>

#include "io/recording/recording.h"
#include "sensor/frame_source.h"
#include "sensor/replay_position.h"

namespace barehand {

/// Which frames of a recording are played, and in which order.
struct FolderRange {
  std::optional<std::int64_t> start;  ///< number of the first frame; none: the first one or, backwards, the last one
  std::int64_t step = 1;              ///< every step-th frame; negative plays backwards, down to frame 0
};

/// Plays a recording folder (docs/formats.md). Frames keep the recording's own numbers and time stamps, also backwards,
/// where time stamps decrease. A frame whose depth cannot be read, or that FrameOrder rejects, is delivered as
/// SkippedFrame, and playing continues.
class FolderSource : public FrameSource {
 public:
  /// Errors: those of open_recording, a start outside the recording, a step of 0.
  static Result<std::unique_ptr<FolderSource>> open(const std::string& directory, const FolderRange& range = {});

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return false; }
  std::string name() const override { return "folder:" + recording_.directory; }

  const Recording& recording() const { return recording_; }
  /// Number of events that `next` will still deliver, for showing progress.
  std::int64_t remaining() const { return position_.remaining(); }

 private:
  FolderSource(Recording recording, const ReplayPosition& position)
      : recording_(std::move(recording)), position_(position) {}

  Recording recording_;
  ReplayPosition position_;
};

}  // namespace barehand
