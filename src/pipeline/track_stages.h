#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "core/error.h"
#include "core/parallel/parallel.h"
#include "hand/contacts.h"
#include "hand/grasps/frame_grasps.h"
#include "hand/hand_pose.h"
#include "object/known_object.h"
#include "observe/observation.h"
#include "pipeline/config.h"
#include "pipeline/reload.h"
#include "stages/contact/object_track.h"
#include "tracking/commanded_tracker.h"

namespace barehand {

/// The stages of PipelineStages that compute: each function owns the objects that it calls.
struct TrackStages {
  std::function<Result<HandObservations>(const FramePtr& frame, const HandEstimates& feedback)> preprocess;
  std::function<Result<HandEstimates>(HandObservations& observations)> track;
  /// Also finds the objects that the tracker gets back, then without contacts if the configuration wants none and no
  /// object is known. Empty if neither is wanted.
  std::function<Result<FrameContactsPtr>(const HandObservations& observations, const HandEstimates& estimates)> contact;
  /// Empty if the configuration wants no grasps, or the classifier cannot be used, which is logged.
  std::function<Result<FrameGraspsPtr>(const HandEstimates& estimates, const FrameContactsPtr& contacts)> grasp;
};

/// Looks at the objects without a mesh after the contacts of each frame, on the thread of the sinks.
using ObjectWatcher = std::function<void(std::span<const ObjectTrack> objects)>;

/// `profiles`: one for each hand to track. `initial`: pose from which the first hand is tracked; none: it is searched.
/// `inbox`: commands from outside; may be empty. `pending`: changed parameters, taken before every frame; may be null.
/// `objects`: those whose shape is known; if there are any, contacts are stated whatever the configuration says.
/// `watch_objects`: may be empty.
/// `workers`, `log` and `pending` must outlive the stages.
TrackStages make_track_stages(const Config& config, const TwoHandTracker::Profiles& profiles,
                              const std::optional<HandPose>& initial, CommandedTracker::Inbox inbox, Workers& workers,
                              RepeatLog& log, PendingParams* pending = nullptr,
                              const std::vector<KnownObjectPtr>& objects = {}, ObjectWatcher watch_objects = {});

}  // namespace barehand
