#pragma once

#include "tracking/tracker_params.h"

namespace barehand {

/// Improves a pose that a search found: a search leaves joints without data at random angles. Unobserved joints are
/// set to neutral angles (with_hidden_neutral) and the pose is refined again. The found pose is returned unchanged if
/// its score is lower by both the fraction `search_advantage` and a fraction of the sensor's noise, or if
/// `neutral_joints` is off.
RefinedPose neutral_pose(const HandObservation& observation, const RefinedPose& found, const HandProfile& profile,
                         const Refinement& refinement, const TrackerParams& params);

}  // namespace barehand
