#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "core/error.h"
#include "core/parallel/parallel.h"
#include "hand/hand_pose.h"
#include "observe/observation.h"
#include "pipeline/config.h"
#include "pipeline/reload.h"
#include "tracking/commanded_tracker.h"

namespace barehand {

/// The two computing stages as the pipeline wants them; they own their stage objects.
struct TrackStages {
  std::function<Result<HandObservations>(const FramePtr& frame, const HandEstimates& feedback)> preprocess;
  std::function<Result<HandEstimates>(const HandObservations& observations)> track;
};

/// `profiles`: of the hands to track. `initial`: start the first from this pose; none: find it. `inbox`: commands from
/// outside; may be empty. `pending`: looked at before every frame; may be null. `workers`, `log` and `pending` outlive
/// the stages.
TrackStages make_track_stages(const Config& config, const TwoHandTracker::Profiles& profiles,
                              const std::optional<HandPose>& initial, CommandedTracker::Inbox inbox, Workers& workers,
                              RepeatLog& log, PendingParams* pending = nullptr);

}  // namespace barehand
