#pragma once

#include <memory>

#include "hand/skin.h"
#include "observe/observation.h"
#include "stages/preprocess/params.h"
#include "tracking/tracker_params.h"

namespace barehand::bench {

/// What the stages see in an ordinary frame, with the default parameters: a hand with bent fingers 0.5 m before a
/// 640x480 camera, an arm's length before a grey wall.
struct World {
  TrackerParams tracker;
  PreprocessParams preprocess;
  std::shared_ptr<const HandProfile> profile;
  std::shared_ptr<const Skin> skin;
  std::shared_ptr<const HandSurface> surface;
  HandPose pose, predicted;  ///< the truth, and 3 mm and 3 degrees beside it
  FramePtr frame;
  HandObservationPtr observation;
};

/// Made once per program.
const World& world();

/// The estimate of the frame before.
HandEstimate earlier_estimate(const World& world);
/// The same as the preprocess stage gets it.
HandEstimates feedback(const World& world);

}  // namespace barehand::bench
