#pragma once

#include "stages/refinement/refinement.h"

namespace barehand {

/// What keeps a pose from the truth although the energy is at its minimum.
struct UncertaintyParams {
  double skin_deviation = 0.0007;   ///< m, of the person's skin from the model's, common to a patch
  double skin_patch = 0.010;        ///< m, side of such a patch: more pixels within it say no more
  double joint_deviation = 0.0005;  ///< m, per axis, of a joint's place within the skin, which no picture shows
  double mean_hand_factor = 3;      ///< on both, where the profile is a mean hand, fitted or not
  double scanned_factor = 0.85;     ///< on both, where the skin was scanned
  double range_share = 0.4;         ///< deviation of a joint that was not seen for long, of that of its whole range
  double just_hidden_deg = 4;       ///< deviation of a joint when it vanishes
  double growth_deg = 30;           ///< growth of it in a second; with the square root of the time
  bool operator==(const UncertaintyParams&) const = default;
};

template <class V>
void visit(V& v, UncertaintyParams& p) {
  v("skin_deviation", p.skin_deviation, 1e-5, 0.1, "m, of the person's skin from the model's, common to a patch");
  v("skin_patch", p.skin_patch, 1e-3, 0.1, "m, side of such a patch: more pixels within it say no more");
  v("joint_deviation", p.joint_deviation, 0.0, 0.1, "m, per axis, of a joint's place within the skin");
  v("mean_hand_factor", p.mean_hand_factor, 1.0, 100.0, "on both, where the profile is a mean hand, fitted or not");
  v("scanned_factor", p.scanned_factor, 0.01, 1.0, "on both, where the skin was scanned");
  v("range_share", p.range_share, 0.01, 10.0,
    "deviation of a joint that was not seen for long, relative to that of its whole range");
  v("just_hidden_deg", p.just_hidden_deg, 0.1, 90.0, "degrees, deviation of a joint when it vanishes");
  v("growth_deg", p.growth_deg, 0.1, 3600.0, "degrees after a second, growth of it with the square root of the time");
}

/// Covariance of every segment of a refined pose: marginals, on the hand's tree, of what the frame says (every patch of
/// skin once), of the joints that hold the segments together, and of how long a hidden joint has had to move.
/// Follows one hand from frame to frame.
class PoseUncertainty {
 public:
  PoseUncertainty(const UncertaintyParams& params, const EnergyParams& energy);

  /// Another hand, or one found anew: nothing is known of joints that are not seen.
  void restart();
  /// Once a frame. `hidden[s]`: the segment's pose comes from structure and motion; `dt`: since the frame before [s].
  /// Covariances of the boxplus twist (translation, rotation), camera frame.
  std::array<Matrix6d, kSegmentCount> covariance(const HandProfile& profile, const RefinedPose& refined,
                                                 const std::array<bool, kSegmentCount>& hidden, double dt);

 private:
  UncertaintyParams params_;
  EnergyParams energy_;
  std::array<double, kSegmentCount> hidden_for_;  // [s]
};

/// Probability that a point whose error has this covariance [m^2] is within `radius` [m] of the truth: a weighted sum
/// of three squared normals, taken as a gamma distribution of the same mean and variance (Satterthwaite 1946).
double probability_within(double radius, const Eigen::Matrix3d& covariance);

}  // namespace barehand
