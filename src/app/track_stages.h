#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "app/commanded_tracker.h"
#include "app/config.h"
#include "app/reload.h"
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

/// `initial`: start from this pose; none: find the hand. `inbox`: commands from outside; may be empty. `news`: looked
/// at before every frame; may be null. `workers`, `log` and `news` outlive the stages.
TrackStages make_track_stages(const Config& config, std::shared_ptr<const HandProfile> profile,
                              const std::optional<HandPose>& initial, CommandedTracker::Inbox inbox, Workers& workers,
                              RepeatLog& log, NewParams* news = nullptr);

}  // namespace barehand
