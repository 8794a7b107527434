#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

#include "app/record/frame_writer.h"
#include "core/clock.h"
#include "sensor/frame_source.h"

namespace barehand {

// Copies frames from a source to a log or folder, for `barehand record` and `barehand convert`.

struct CopyOptions {
  std::int64_t frames = 0;                    ///< stop after this many frames; 0 = no limit
  double seconds = 0;                         ///< stop after this time [s]; 0 = no limit
  std::optional<std::int64_t> expected = {};  ///< number of frames to come, if known, shown with the progress
  bool terminal = false;                      ///< show the progress in one line, which is rewritten
  bool quiet = false;                         ///< report only problems, no progress
  std::function<void(const struct CopyResult&)> on_step =
      {};  ///< called after every event of the source, timeouts included
};

struct CopyResult {
  std::int64_t written = 0;
  std::int64_t skipped = 0;  ///< frames that the source could not read
  std::int64_t missing = 0;  ///< frames that a live source numbered but did not deliver
  std::int64_t dropped = 0;  ///< those missing frames that this program dropped, since it could not write them in time
  std::int64_t lost = 0;     ///< frames that were delivered but not written
  std::string lost_why;      ///< why the last lost frame was not written
  std::optional<Error> error;  ///< what ended the copy early; what was written before is complete
  bool stopped = false;        ///< whether `stop` ended the copy
};

/// Copies frames from a source to a writer until the source ends, a limit is reached or `stop` becomes true. A frame
/// that cannot be written ends the copy, except with a live source: then it counts as lost and the copy continues,
/// since there may be room again later. Prints progress and problems to `report`, a problem of one kind at most once a
/// second.
CopyResult copy_frames(FrameSource& source, FrameWriter& writer, const CopyOptions& options,
                       const std::atomic<bool>& stop, const Clock& clock, std::ostream& report);

}  // namespace barehand
