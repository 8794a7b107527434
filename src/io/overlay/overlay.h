#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "hand/hand_pose.h"
#include "hand/skin.h"
#include "io/overlay/overlay_drawing.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Writes what draw_overlay draws: to a video (VideoFile; `path` ends in .mp4, .mkv, .webm or .avi), or as one JPEG per
/// frame, named by the frame's number, to a folder, which is created.
class OverlayWriter {
 public:
  /// `fps`: frame rate of a video. `overwrite`: the first image that is written to a folder replaces all images that an
  /// earlier writer left there; other files stay. Errors: a folder that cannot be created; those of VideoFile.
  static Result<OverlayWriter> open(const std::string& path, double fps, bool overwrite = false,
                                    SegmentNames names = SegmentNames::left_out);
  OverlayWriter(OverlayWriter&&) noexcept;
  OverlayWriter& operator=(OverlayWriter&&) noexcept;
  ~OverlayWriter();

  /// Draws and writes a frame. Errors: a full disk; in a video, frames that change their size.
  Result<void> write(const RgbdFrame& frame, const HandEstimates& estimates);
  /// Ends a video and gives it its name; the destructor does so too, but cannot report errors.
  Result<void> finish();

 private:
  class Output;
  class Folder;
  class Video;
  OverlayWriter(std::unique_ptr<Output> output, SegmentNames names);

  /// The skin of a hand's profile.
  struct HandSkin {
    std::shared_ptr<const HandProfile> profile;
    Skin skin;
    void follow(const HandEstimate& estimate);
  };

  std::unique_ptr<Output> output_;
  SegmentNames names_;
  std::vector<HandSkin> skins_;           // one for each hand
  std::optional<std::int64_t> first_us_;  // time of the first frame

  /// The depths that are coloured. Without a hand, the right image stays at those around the hands seen last.
  SteadyRange left_, right_;
  std::optional<ColouredDepths> around_;  // the hands seen last
};

}  // namespace barehand
