#pragma once

#include <memory>

#include "hand/hand_pose.h"
#include "observe/observation.h"

namespace barehand {

/// Tracks one hand through a sequence of observations, in order: prediction, then segment tracker and fusion level by
/// level, then refinement and the choice of the best hypothesis. Synchronous; owns no thread, clock, file or socket.
class HandTracker {
 public:
  virtual ~HandTracker() = default;
  virtual HandEstimatePtr process(const HandObservationPtr& observation) = 0;
};

}  // namespace barehand
