#pragma once

#include <chrono>
#include <string>
#include <variant>
#include <vector>

#include "core/error.h"
#include "core/statistics.h"
#include "math/frame.h"

namespace barehand {

struct EndOfStream {};
struct Timeout {};  ///< nothing arrived in time; ask again
struct SkippedFrame {
  Error error;
};  ///< one frame was unreadable: count it, report it, ask for the next
struct SourceFailed {
  Error error;
};  ///< the source cannot go on

/// Something to tell the user, once; the stream goes on. The source keeps repetitions back.
struct SourceNotice {
  Error error;
  bool trouble = true;  ///< false: good news (a sensor was opened)
};

using SourceEvent = std::variant<FramePtr, EndOfStream, Timeout, SkippedFrame, SourceFailed, SourceNotice>;

/// Where frames come from: a folder, a log, a live bus, a sensor, the simulator. Used by one thread at a time.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// The next frame in order, or why there is none. Live sources wait at most `patience`.
  virtual SourceEvent next(std::chrono::milliseconds patience) = 0;
  /// Live frames may be dropped at the door when the tracker is slow; replayed ones never are.
  virtual bool live() const = 0;
  /// "folder:/data/fist", for messages.
  virtual std::string name() const = 0;
  /// What frames pass before they get here, first to last. Frames that a network lost count as dropped by a queue
  /// without capacity. Any thread.
  virtual std::vector<QueueHealth> queues() const { return {}; }
};

}  // namespace barehand
