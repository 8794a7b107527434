#pragma once

#include "app/tracker_params.h"

namespace barehand {

/// A pose that a search found, with what no data holds at ease (with_hidden_at_ease) and refined again: a search bends
/// that at random. As it was found if that explains the frame better, by more than `search_advantage` and the noise.
RefinedPose relaxed_pose(const HandObservation& observation, const RefinedPose& found, const HandProfile& profile,
                         const Refinement& refinement, const TrackerParams& params);

}  // namespace barehand
