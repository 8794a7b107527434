// Bends the hidden fingers of a found pose like a hand at rest.
#include "tracking/hypotheses/neutral_pose.h"

#include <algorithm>

#include "stages/pose_prior/hidden_fingers.h"

namespace barehand {

RefinedPose neutral_pose(const HandObservation& observation, const RefinedPose& found, const HandProfile& profile,
                         const Refinement& refinement, const TrackerParams& params) {
  if (!params.neutral_joints) return found;

  // Visible fraction above which a segment counts as observed; a thin visible strip fits nearly any angle.
  constexpr double kObserved = 0.5;
  // Differences of the score below this fraction of the sensor's noise are insignificant.
  constexpr double kIndistinct = 0.1;
  // One pass is not enough: in the first one, the observed joints that the neutral angles are derived from were refined
  // with hidden joints at random angles.
  constexpr int kPasses = 2;

  // Joints count as observed if enough of their segment is visible.
  std::array<bool, kSegmentCount> seen;
  for (int s = 0; s < kSegmentCount; ++s) seen[s] = found.visible[s] > kObserved;

  // Set the unobserved joints to neutral angles and refine.
  RefinedPose neutral = found;
  for (int pass = 0; pass < kPasses; ++pass) {
    const HandPose pose = with_hidden_neutral(profile, neutral.pose, seen);
    neutral = refinement.refine(observation, pose, pose, params.search_iterations);
  }

  // Keep the neutral pose unless it explains the data clearly worse.
  const double worse = std::max(params.choice.search_advantage * found.score, kIndistinct * observation.noise);
  return neutral.score < found.score + worse ? neutral : found;
}

}  // namespace barehand
