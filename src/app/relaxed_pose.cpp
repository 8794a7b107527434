#include "app/relaxed_pose.h"

#include <algorithm>

#include "stages/prediction/hidden_fingers.h"

namespace barehand {

RefinedPose relaxed_pose(const HandObservation& observation, const RefinedPose& found, const HandProfile& profile,
                         const Refinement& refinement, const TrackerParams& params) {
  constexpr double kHeld = 0.5;        // visible: what is seen by a sliver goes with nearly any bend
  constexpr double kIndistinct = 0.1;  // of the sensor's noise: a mean distance that is less worse tells nothing
  constexpr int kPasses = 2;           // a joint that hidden ones bend like moves once they no longer hold it
  std::array<bool, kSegmentCount> seen;
  for (int s = 0; s < kSegmentCount; ++s) seen[s] = found.visible[s] > kHeld;
  RefinedPose relaxed = found;
  for (int pass = 0; pass < kPasses; ++pass) {
    const HandPose pose = with_hidden_at_ease(profile, relaxed.pose, seen);
    relaxed = refinement.refine(observation, pose, pose, params.search_iterations);
  }
  const double worse = std::max(params.search_advantage * found.score, kIndistinct * observation.noise);
  return relaxed.score < found.score + worse ? relaxed : found;
}

}  // namespace barehand
