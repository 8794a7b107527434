#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "math/frame.h"

namespace barehand {

/// One line of depth.txt with the colour image nearest in time.
struct RecordingEntry {
  std::int64_t utime = 0;      ///< microseconds
  std::string depth_file;      ///< path to open
  std::string colour_file;     ///< "": this frame has no colour
  bool repeats_stamp = false;  ///< same stamp as the line before: a frame written twice, to be skipped
};

/// A recording folder (docs/formats.md) as its index files describe it; images are read on demand.
struct Recording {
  std::string directory;
  Intrinsics camera;
  double depth_unit = 0.001;            ///< metres per count
  double fps = 0;                       ///< nominal frames per second; 0 = not stated
  std::vector<RecordingEntry> entries;  ///< by rising time; the position is the frame number
};

/// Reads camera.json, depth.txt and, where there is one, rgb.txt, and looks at the first image. An error says which
/// file and line or key is wrong: missing intrinsics, no frames, stamps that go back, depth of another size.
Result<Recording> open_recording(const std::string& directory);

/// Decodes one frame; `number` is its position in `entries`. An unreadable or misshapen image is an error naming it.
Result<FramePtr> read_frame(const Recording& recording, std::int64_t number);

}  // namespace barehand
