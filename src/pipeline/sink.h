#pragma once

#include <string>

#include "core/error.h"
#include "hand/hand_pose.h"
#include "observe/observation.h"

namespace barehand {

/// One frame with all that became of it.
struct TrackedFrame {
  FramePtr frame;
  HandObservations observations;
  HandEstimates estimates;
};

/// Where results go: the bus, a table, a log, pictures. Used by one thread, in the order of the frames.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual std::string name() const = 0;
  virtual Result<void> consume(const TrackedFrame& tracked) = 0;
  /// No frame came for a while: what is due by the clock. Called again and again until one comes.
  virtual Result<void> idle() { return {}; }
  /// After the last frame, also of a run that failed: everything written is on disk when it returns.
  virtual Result<void> finish() { return {}; }
};

}  // namespace barehand
