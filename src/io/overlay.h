#pragma once

#include <memory>
#include <string>

#include "core/error.h"
#include "hand/hand_pose.h"
#include "hand/surface.h"
#include "math/frame.h"

namespace barehand {

/// Writes what draw_overlay draws: to a video (path ends in .mp4 or .avi) or as one JPEG per frame, named by its
/// number, into a folder, which is made.
class OverlayWriter {
 public:
  /// `fps`: of the video. `surface`: the skin to outline; without it that of the estimate's profile (cylinders).
  /// Errors: a folder that cannot be made, a video codec that is not installed.
  static Result<OverlayWriter> open(const std::string& path, double fps,
                                    std::shared_ptr<const HandSurface> surface = nullptr);
  OverlayWriter(OverlayWriter&&) noexcept;
  OverlayWriter& operator=(OverlayWriter&&) noexcept;
  ~OverlayWriter();

  /// Errors: a full disk; in a video, frames that change their size.
  Result<void> write(const RgbdFrame& frame, const HandEstimate& estimate);
  /// Closes a video, which cannot be played before; the destructor does so too, but cannot report errors.
  Result<void> finish();

 private:
  class Output;
  class Folder;
  class Video;
  OverlayWriter(std::unique_ptr<Output> output, std::shared_ptr<const HandSurface> surface);
  const HandSurface& skin_of(const HandEstimate& estimate);

  std::unique_ptr<Output> output_;
  std::shared_ptr<const HandSurface> surface_;
  bool own_surface_;  ///< made here, for profile_
  std::shared_ptr<const HandProfile> profile_;
};

}  // namespace barehand
