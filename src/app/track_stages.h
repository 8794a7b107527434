#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "app/config.h"
#include "core/error.h"
#include "core/parallel.h"
#include "hand/hand_pose.h"
#include "observe/observation.h"

namespace barehand {

/// The two computing stages as the pipeline wants them; they own their stage objects.
struct TrackStages {
  std::function<Result<HandObservationPtr>(const FramePtr& frame, const HandEstimate* hint)> preprocess;
  std::function<Result<HandEstimatePtr>(const HandObservationPtr& observation)> track;
};

/// `initial`: start from this pose; none: find the hand. `workers` outlive the stages.
TrackStages make_track_stages(const Config& config, std::shared_ptr<const HandProfile> profile,
                              const std::optional<HandPose>& initial, Workers& workers);

}  // namespace barehand
