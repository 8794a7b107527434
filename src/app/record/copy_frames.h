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

struct CopyOptions {
  std::int64_t frames = 0;                    ///< stop after this many; 0 = all
  double seconds = 0;                         ///< stop after this time; 0 = no limit
  std::optional<std::int64_t> expected = {};  ///< how many will come, where that is known: for progress
  bool terminal = false;                      ///< progress rewrites one line
  bool quiet = false;                         ///< no progress, only trouble
  std::function<void(const struct CopyResult&)> on_step = {};  ///< called after every answer of the source
};

struct CopyResult {
  std::int64_t written = 0;
  std::int64_t skipped = 0;  ///< unreadable at the source
  std::int64_t missing =
      0;  ///< numbered by a live source but never delivered: lost on the way or dropped from the input queue
  std::int64_t dropped = 0;    ///< of those: dropped here, because frames came faster than they could be written
  std::int64_t lost = 0;       ///< delivered but not written
  std::string lost_why;        ///< the last of them
  std::optional<Error> error;  ///< what ended the copy early; what was written before is complete
  bool stopped = false;        ///< by `stop`
};

/// Copies frames from a source to a writer until the source ends, a limit is reached or `stop` becomes true. A frame of
/// a live source that cannot be written is lost, and the copy goes on: there may be room again. Otherwise it ends. Says
/// on `report` how far it is, and what was skipped (each kind of trouble once in a while, the count always).
CopyResult copy_frames(FrameSource& source, FrameWriter& writer, const CopyOptions& options,
                       const std::atomic<bool>& stop, const Clock& clock, std::ostream& report);

}  // namespace barehand
