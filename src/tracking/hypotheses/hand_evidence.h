#pragma once

#include <cstdint>
#include <vector>

#include "observe/detection.h"
#include "stages/refinement/refinement.h"

namespace barehand {

/// What the networks say for a detected hand being one. They were trained to find hands, so they find palms elsewhere,
/// too: on feet and faces, at the end of an arm whose hand is not seen. There they contradict each other.
struct HandCues {
  double palm = 0;    ///< DetectedHand::palm
  double side = 0;    ///< how clear the side is: amount of DetectedHand::right_log_odds
  double labels = 0;  ///< mean log odds of hand over what the window's labels call hand
  double misfit = 0;  ///< KinematicFit::cost of the joints, a hand of any size allowed
};
/// The cues of a detected hand. `profile`: of either side, as both are mirror images.
HandCues hand_cues(const DetectedHand& detected, const HandProfile& profile);

/// Log odds of a hand against something else that the networks take for one, where both are equally common: a logistic
/// model, fitted to scenes with and without hands (docs/method.md).
double log_odds_of_hand(const HandCues& cues);
/// What a pose adds to them that was refined from the detected joints: a foot is explained badly, or by a pose that has
/// left the joints. Joints that are not seen may be anywhere.
double log_odds_of_pose(const RefinedPose& refined, const HandProfile& profile, const DetectedHand& detected);

/// Log odds of what is seen at each place, kept over frames. Successive frames share most of their errors, so those
/// before the present one count little.
class HandEvidence {
 public:
  /// Adds the log odds of a frame at `centre`, camera frame [m], and returns those of all frames. A frame counts once
  /// at each place: of several looks, the last one. What is seen elsewhere than before is something new.
  double add(std::uint32_t frame, const Eigen::Vector3d& centre, double log_odds);
  /// Forgets what was seen at `centre`.
  void forget(const Eigen::Vector3d& centre);
  /// Forgets all places.
  void forget() { places_.clear(); }

 private:
  struct Place {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // where it was seen last
    std::uint32_t frame = 0;                           // the last one that was added
    double before = 0, sum = 0;                        // leaky sums: before that frame, and with it
  };
  std::vector<Place> places_;
};

}  // namespace barehand
