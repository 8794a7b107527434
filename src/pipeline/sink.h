#pragma once

#include <string>

#include "core/error.h"
#include "hand/contacts.h"
#include "hand/grasps/frame_grasps.h"
#include "hand/hand_pose.h"
#include "observe/observation.h"

namespace barehand {

/// One frame with the results of all stages.
struct TrackedFrame {
  FramePtr frame;
  HandObservations observations;
  HandEstimates estimates;
  FrameContactsPtr contacts = {};  ///< null: nobody asked for them, or their stage failed
  FrameGraspsPtr grasps = {};      ///< null: likewise
};

/// An output of the pipeline: the bus, a table, a log, images. Used by one thread, in the order of the frames.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual std::string name() const = 0;
  /// Whether it needs nothing but the hands: it then gets each frame before contacts and grasps are found.
  virtual bool only_hands() const { return false; }
  virtual Result<void> consume(const TrackedFrame& tracked) = 0;
  /// Does work that depends on the time, such as periodic messages. Called repeatedly while no frame arrives.
  virtual Result<void> idle() { return {}; }
  /// Called after the last frame, also if the run failed. When it returns, everything written is on disk.
  virtual Result<void> finish() { return {}; }
};

}  // namespace barehand
