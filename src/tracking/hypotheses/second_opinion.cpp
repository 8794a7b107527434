// Refines the pose that a second look of the networks found, beside the tracking.
#include "tracking/hypotheses/second_opinion.h"

#include <algorithm>
#include <utility>

#include "stages/search/inverse_kinematics.h"
#include "tracking/hypotheses/choice.h"
#include "tracking/hypotheses/neutral_pose.h"

namespace barehand {

struct SecondOpinion::Question {
  TrackerParams params;
  std::shared_ptr<const HandProfile> profile;
  std::shared_ptr<const Skin> skin;
  HandObservation observation;  // with the second look
  HandPose followed;
  double score;  // of the followed pose

  std::optional<Better> answer() const;
};

std::optional<SecondOpinion::Better> SecondOpinion::Question::answer() const {
  // The joints must agree with a pose about as well as usual, and better than with the followed one.
  const DetectedJoints& joints = observation.second_look->joints;
  const double least = std::min(kTrustedJointCost, joint_cost(*profile, followed, joints) - kJointCostAdvantage);
  const auto agrees_better = [&](const RefinedPose& pose) { return joint_cost(*profile, pose.pose, joints) < least; };
  const auto fit = fit_to_joints(*profile, joints);
  if (!fit || fit->cost >= least) return std::nullopt;

  // Hidden joints are set last, since most looks only confirm the followed pose.
  const Refinement refinement(params.refinement, profile, skin);
  RefinedPose found = refinement.refine(observation, fit->pose, fit->pose, params.search_iterations);
  if (!agrees_better(found) || !clearly_better(found.score, score, -kHandAdvantage)) return std::nullopt;
  found = neutral_pose(observation, found, *profile, refinement, params);
  if (!agrees_better(found) || found.score > score) return std::nullopt;
  return Better{found.pose, followed};
}

std::optional<HandPose> SecondOpinion::next(const HandObservation& observation, const HandModel& hand,
                                            const Hypothesis& followed, std::uint32_t frame) {
  const auto found = better_.take(frame);
  if (observation.second_look && !better_.pending()) {
    // The question holds copies, since the tracker goes on meanwhile.
    Question question{context_.params, hand.profile, hand.skin, observation, followed.refined.pose, followed.score()};
    better_.begin(frame, context_.workers.run_in_background(
                             [question = std::move(question)](Workers&) { return question.answer(); }));
  }
  if (!found || !*found) return std::nullopt;

  HandPose pose = (*found)->pose;
  const SE3 motion = followed.refined.pose[kPalm] * (*found)->followed[kPalm].inverse();
  for (SE3& segment : pose) segment = motion * segment;
  return pose;
}

}  // namespace barehand
