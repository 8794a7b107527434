#pragma once

#include <chrono>
#include <string>
#include <variant>
#include <vector>

#include "core/error.h"
#include "core/statistics.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

// The interface of all sources of frames.

/// Events that a source returns instead of a frame.
struct EndOfStream {};
struct Timeout {};  ///< no frame arrived in time; call next() again
struct SkippedFrame {
  Error error;
};  ///< one frame was unreadable: count and report it, and ask for the next
struct SourceFailed {
  Error error;
};  ///< the source cannot continue

/// A message for the user; the stream continues. The source itself suppresses repetitions.
struct SourceNotice {
  Error error;
  bool trouble = true;  ///< whether it is a warning; false: information only, for example that a sensor was opened
};

using SourceEvent = std::variant<FramePtr, EndOfStream, Timeout, SkippedFrame, SourceFailed, SourceNotice>;

/// A source of frames: a folder, a log, a live bus, a sensor or the simulator. Used by one thread at a time.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// The next frame in order, or the reason why there is none. Live sources wait no longer than `patience`.
  virtual SourceEvent next(std::chrono::milliseconds patience) = 0;
  /// Whether frames arrive in real time. They may then be dropped at the input queue when the tracker is slow;
  /// replayed frames never are.
  virtual bool live() const = 0;
  /// Name for messages, such as "folder:/data/fist".
  virtual std::string name() const = 0;
  /// Health of the queues that frames pass within the source, from first to last. Frames lost by a network count as
  /// dropped by a queue without capacity. Any thread may call it.
  virtual std::vector<QueueHealth> queues() const { return {}; }
};

}  // namespace barehand
