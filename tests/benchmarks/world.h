#pragma once

#include <memory>

#include "hand/skin.h"
#include "observe/observation.h"
#include "stages/preprocess/params.h"
#include "tracking/tracker_params.h"

namespace barehand::bench {

/// Input of the stages for an ordinary frame, with the default parameters: a hand with bent fingers 0.5 m in front of a
/// 640x480 camera, and a grey wall an arm's length behind it.
struct World {
  TrackerParams tracker;
  PreprocessParams preprocess;
  std::shared_ptr<const HandProfile> profile;
  std::shared_ptr<const Skin> skin;
  std::shared_ptr<const HandSurface> surface;
  HandPose pose, predicted;  ///< the true pose, and one that is off by 3 mm and 3 degrees
  FramePtr frame;
  HandObservationPtr observation;
};

/// The same object for all benchmarks, made in the first call.
const World& world();

/// The estimate of the previous frame.
HandEstimate earlier_estimate(const World& world);
/// The estimate of the previous frame, in the form in which the preprocess stage gets it.
HandEstimates feedback(const World& world);

}  // namespace barehand::bench
