#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "sensor/rgbd_frame.h"
#include "sensor/undistortion.h"

namespace barehand {

/// One line of depth.txt with the colour image nearest in time.
struct RecordingEntry {
  std::int64_t utime = 0;    ///< microseconds
  std::string depth_file;    ///< path to open
  std::string colour_file;   ///< "": this frame has no colour
  std::string colour_fault;  ///< why it has none although others do
  std::string fault;         ///< why the frame is not used (FrameOrder); "": it is
};

/// A recording folder (docs/formats.md) as its index files describe it; images are read on demand.
struct Recording {
  std::string directory;
  Intrinsics camera;
  double depth_unit = 0.001;                         ///< metres per count
  double fps = 0;                                    ///< nominal frames per second; 0 = not stated
  std::vector<RecordingEntry> entries;               ///< in the order of depth.txt; the position is the frame number
  std::shared_ptr<const Undistortion> undistortion;  ///< of all images; null: they are a pinhole's
  std::vector<std::string> doubts;                   ///< what is to be said of it, in sentences
};

/// Reads camera.json, depth.txt and, where there is one, rgb.txt, and looks at the first image. An error says which
/// file and line or key is wrong: missing intrinsics, no frames, stamps that are no times, depth of another size. What
/// is wrong with colour is a doubt.
Result<Recording> open_recording(const std::string& directory);

/// Decodes one frame; `number` is its position in `entries`. Unreadable or misshapen depth is an error naming the
/// image; such colour is left out, and the frame says why.
Result<FramePtr> read_frame(const Recording& recording, std::int64_t number);

}  // namespace barehand
