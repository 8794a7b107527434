// Refines the pose that a second look of the networks found, beside the tracking.
#include "tracking/hypotheses/second_opinion.h"

#include <algorithm>
#include <utility>

#include "stages/search/inverse_kinematics.h"
#include "tracking/hypotheses/choice.h"
#include "tracking/hypotheses/neutral_pose.h"

namespace barehand {

std::optional<HandPose> SecondOpinion::next(const HandObservation& observation, const HandModel& hand,
                                            const Hypothesis& followed, std::uint32_t frame) {
  const auto found = better_.take(frame);
  if (observation.second_look && !better_.pending()) examine(observation, hand, followed, frame);
  if (!found || !*found) return std::nullopt;
  HandPose pose = (*found)->pose;
  const SE3 motion = followed.refined.pose[kPalm] * (*found)->followed[kPalm].inverse();
  for (SE3& segment : pose) segment = motion * segment;
  return pose;
}

void SecondOpinion::examine(const HandObservation& observation, const HandModel& hand, const Hypothesis& followed,
                            std::uint32_t frame) {
  // The joints must agree with a pose about as well as usual, and better than with the followed one.
  const DetectedJoints& joints = observation.second_look->joints;
  const double present = joint_cost(*hand.profile, followed.refined.pose, joints);
  const double least = std::min(kTrustedJointCost, present - kJointCostAdvantage);
  const auto fit = fit_to_joints(*hand.profile, joints);
  if (!fit || fit->cost >= least) return;

  // Everything is copied, since the tracker goes on meanwhile.
  better_.begin(frame,
                context_.workers.run_in_background(
                    [params = context_.params, observation, profile = hand.profile, skin = hand.skin, start = fit->pose,
                     least, pose = followed.refined.pose, score = followed.score()](Workers&) -> std::optional<Better> {
                      const auto agrees_better = [&](const RefinedPose& other) {
                        return joint_cost(*profile, other.pose, observation.second_look->joints) < least;
                      };
                      // Hidden joints are set last, since most looks only confirm the followed pose.
                      const Refinement refinement(params.refinement, profile, skin);
                      RefinedPose other = refinement.refine(observation, start, start, params.search_iterations);
                      if (!agrees_better(other) || !clearly_better(other.score, score, -kHandAdvantage))
                        return std::nullopt;
                      if (params.neutral_joints) other = neutral_pose(observation, other, *profile, refinement, params);
                      if (!agrees_better(other) || other.score > score) return std::nullopt;
                      return Better{other.pose, pose};
                    }));
}

}  // namespace barehand
