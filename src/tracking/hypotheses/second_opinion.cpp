// Refines what a second look of the networks found, the whole pose or single fingers, beside the tracking.
#include "tracking/hypotheses/second_opinion.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "hand/articulated_pose.h"
#include "stages/search/inverse_kinematics.h"
#include "tracking/hypotheses/choice.h"
#include "tracking/hypotheses/neutral_pose.h"

namespace barehand {
namespace {

constexpr double kOtherPlace = 0.02;  // a finger of which an end of a segment moves farther lies elsewhere [m]

/// Whether a finger lies elsewhere in another pose.
bool lies_elsewhere(const HandProfile& profile, const HandPose& pose, const HandPose& other, int finger) {
  return std::ranges::any_of(std::array{0, 1, 2}, [&](int k) {
    const int s = segment_of(finger, k);
    return (distal_end(profile, pose, s) - distal_end(profile, other, s)).norm() >= kOtherPlace;
  });
}

}  // namespace

struct SecondOpinion::Question {
  TrackerParams params;
  std::shared_ptr<const HandProfile> profile;
  std::shared_ptr<const Skin> skin;
  HandObservation observation;
  DetectedJoints joints;  // of the look
  HandPose followed;
  double score;  // of the followed pose

  std::optional<Better> answer() const;

 private:
  // The refined pose of the look, if it explains the frame no worse than the followed pose and agrees better with the
  // joints.
  std::optional<HandPose> whole_hand(const Refinement& refinement, const KinematicFit& fit) const;
  // The followed pose with one or all of those fingers that the look sees elsewhere, refined, if that explains the
  // frame clearly better and agrees better with the joints.
  std::optional<HandPose> exchanged_fingers(const Refinement& refinement, const HandPose& seen) const;
};

std::optional<SecondOpinion::Better> SecondOpinion::Question::answer() const {
  const auto fit = fit_to_joints(*profile, joints);
  if (!fit) return std::nullopt;
  const Refinement refinement(params.refinement, profile, skin);
  auto better = whole_hand(refinement, *fit);
  if (!better) better = exchanged_fingers(refinement, fit->pose);
  if (!better) return std::nullopt;
  return Better{*better, followed};
}

std::optional<HandPose> SecondOpinion::Question::whole_hand(const Refinement& refinement,
                                                            const KinematicFit& fit) const {
  // The joints must agree with a pose about as well as usual, and better than with the followed one.
  const double least = std::min(kTrustedJointCost, joint_cost(*profile, followed, joints) - kJointCostAdvantage);
  const auto agrees_better = [&](const RefinedPose& pose) { return joint_cost(*profile, pose.pose, joints) < least; };
  if (fit.cost >= least) return std::nullopt;

  // Hidden joints are set last, since most looks only confirm the followed pose.
  RefinedPose found = refinement.refine(observation, fit.pose, fit.pose, params.search_iterations);
  if (!agrees_better(found) || !clearly_better(found.score, score, -kHandAdvantage)) return std::nullopt;
  found = neutral_pose(observation, found, *profile, refinement, params);
  if (!agrees_better(found) || found.score > score) return std::nullopt;
  return found.pose;
}

std::optional<HandPose> SecondOpinion::Question::exchanged_fingers(const Refinement& refinement,
                                                                   const HandPose& seen) const {
  // Exchange each finger that is seen elsewhere, and all of them together.
  std::vector<HandPose> poses;
  HandPose all = followed;
  for (int finger = 0; finger < kFingerCount; ++finger) {
    const HandPose one = with_finger_of(followed, seen, finger);
    if (!lies_elsewhere(*profile, one, followed, finger)) continue;
    all = with_finger_of(all, seen, finger);
    poses.push_back(one);
  }
  if (poses.size() > 1) poses.push_back(all);

  // Refine them and return the best one.
  std::optional<RefinedPose> best;
  const double cost = joint_cost(*profile, followed, joints);
  for (const HandPose& pose : poses) {
    RefinedPose refined = refinement.refine(observation, pose, pose, params.near_iterations);
    if (!clearly_better(refined.score, score, kExchangeAdvantage)) continue;
    if (best && refined.score >= best->score) continue;
    if (joint_cost(*profile, refined.pose, joints) < cost) best = std::move(refined);
  }
  if (!best) return std::nullopt;
  return best->pose;
}

std::optional<HandPose> SecondOpinion::next(const HandObservation& observation, const HandModel& hand,
                                            const Hypothesis& followed, bool ambiguous, std::uint32_t frame) {
  const auto found = better_.take(frame);
  const DetectedHand* look = observation.second_look.get();
  if (!look && ambiguous) look = observation.detected.get();
  if (look && !better_.pending()) {
    // The question holds copies, since the tracker goes on meanwhile.
    const DetectedJoints& joints = look->joints_of(hand.profile->handedness);
    Question question{context_.params, hand.profile,          hand.skin,       observation,
                      joints,          followed.refined.pose, followed.score()};
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
