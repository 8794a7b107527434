#include "tracking/hypotheses/choice.h"

#include "stages/search/inverse_kinematics.h"

namespace barehand {

double Choice::score_with_detection(const HandObservation& observation, const HandProfile& profile,
                                    const RefinedPose& refined) const {
  if (!observation.detected) return refined.score;
  const DetectedJoints& joints = observation.detected->joints_of(profile.handedness);
  const bool confirmed = mean_distance(profile, refined.pose, joints) < params_.agreement;
  return confirmed ? params_.detection_factor * refined.score : refined.score;
}

bool Choice::replaces(std::string_view rule, const Hypothesis& challenger, const Hypothesis& present,
                      double advantage) {
  const bool replaced = clearly_better(challenger.score(), present.score(), advantage);
  const Hypothesis& winner = replaced ? challenger : present;
  const Hypothesis& loser = replaced ? present : challenger;
  note({rule, to_string(winner.origin), to_string(loser.origin), winner.score(), loser.score(), advantage});
  return replaced;
}

}  // namespace barehand
