#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "sensor/rgbd_frame.h"
#include "sensor/undistortion.h"

namespace barehand {

// A recording folder on disk (docs/formats.md).

/// One line of depth.txt with the colour image nearest in time.
struct RecordingEntry {
  std::int64_t utime = 0;    ///< time stamp of the depth image [us]
  std::string depth_file;    ///< path of the depth image
  std::string colour_file;   ///< path of the colour image; "": this frame has no colour
  std::string colour_fault;  ///< why the frame has no colour although others have
  std::string fault;         ///< why the frame is not used (FrameOrder); "": it is used
};

/// A recording folder (docs/formats.md) as its index files describe it; images are read on demand.
struct Recording {
  std::string directory;
  Intrinsics camera;
  double depth_unit = 0.001;                         ///< metres per unit of the depth images
  double fps = 0;                                    ///< nominal frames per second; 0 = not stated
  std::vector<RecordingEntry> entries;               ///< in the order of depth.txt; the position is the frame number
  std::shared_ptr<const Undistortion> undistortion;  ///< to be applied to all images; null: none is needed
  std::vector<std::string> warnings;                 ///< warnings to the user, in sentences
};

/// Reads camera.json, depth.txt and, if it exists, rgb.txt, and checks the first image. An error names the file and the
/// line or key that is wrong: missing intrinsics, no frames, invalid time stamps, depth of another size. Problems with
/// colour are only added to `warnings`.
Result<Recording> open_recording(const std::string& directory);

/// Decodes one frame; `number` is its position in `entries`. If the depth image is unreadable or of another size, the
/// error names it; if the colour image is, the frame has no colour and its `colour_fault` contains the reason.
Result<FramePtr> read_frame(const Recording& recording, std::int64_t number);

}  // namespace barehand
