#pragma once

#include <cstdint>
#include <vector>

#include "observe/detection.h"
#include "stages/refinement/refinement.h"

namespace barehand {

// Decides whether what the networks detected is a hand at all, by evidence from the refined pose and from successive
// frames besides their own.

/// Log odds from the pose that was refined from the detected joints, in addition to DetectedHand::hand_log_odds. On a
/// foot, that pose has a bad global score or is far from the detected joints. The distance counts less if little of the
/// hand is visible, since detected joints that are hidden are uncertain.
double log_odds_of_pose(const RefinedPose& refined, const HandProfile& profile, const DetectedHand& detected);

/// Accumulates over frames, separately for each place, the log odds that the detection there is a hand. Successive
/// frames have most of their errors in common, so the earlier frames have a small weight.
class HandEvidence {
 public:
  /// Adds the log odds of a frame for a detection at `centre`, camera frame [m], and returns the log odds from all
  /// frames. If a frame is added several times at one place, only the last call counts. A detection far from the last
  /// centre of every place begins a new place.
  double add(std::uint32_t frame, const Eigen::Vector3d& centre, double log_odds);
  /// Forgets the place at `centre`.
  void forget(const Eigen::Vector3d& centre);
  /// Forgets all places.
  void forget() { places_.clear(); }

 private:
  struct Place {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // centre of the last detection there, camera frame [m]
    std::uint32_t frame = 0;                           // number of the last frame that was added
    double before = 0, sum = 0;                        // decaying sums of log odds, without and with the last frame
  };
  std::vector<Place> places_;
};

}  // namespace barehand
