#pragma once

#include "stages/refinement/refinement.h"

namespace barehand {

// The covariances of a refined pose.

/// Standard deviations of the errors that a pose has even at the minimum of the energy, and factors on them. Their
/// causes are errors of the model and joints that were not seen.
struct UncertaintyParams {
  double skin_deviation = 0.0007;
  double skin_patch = 0.010;
  double joint_deviation = 0.0005;
  double mean_hand_factor = 3;
  double scanned_factor = 0.85;
  double range_share = 0.4;
  double just_hidden_deg = 4;
  double growth_deg = 30;
  bool operator==(const UncertaintyParams&) const = default;
};

template <class V>
void visit(V& v, UncertaintyParams& p) {
  // Declare the keys for what is seen.
  v("skin_deviation", p.skin_deviation, 1e-5, 0.1,
    "m, standard deviation of the person's skin from the model's, common to a patch of skin");
  v("skin_patch", p.skin_patch, 1e-3, 0.1,
    "m, side length of a patch of skin with a common deviation; further pixels within it add no information");
  v("joint_deviation", p.joint_deviation, 0.0, 0.1,
    "m, standard deviation per axis of a joint's position within the skin, which no image shows");
  v("mean_hand_factor", p.mean_hand_factor, 1.0, 100.0,
    "factor on skin_deviation and joint_deviation if the profile is a mean hand, fitted or not");
  v("scanned_factor", p.scanned_factor, 0.01, 1.0,
    "factor on skin_deviation and joint_deviation if the skin was scanned");

  // Declare the keys for hidden joints.
  v("range_share", p.range_share, 0.01, 10.0,
    "standard deviation of a joint that has been hidden for long, relative to that of its whole range");
  v("just_hidden_deg", p.just_hidden_deg, 0.1, 90.0,
    "degrees, standard deviation of a joint that has just become hidden");
  v("growth_deg", p.growth_deg, 0.1, 3600.0,
    "degrees, growth of a hidden joint's standard deviation in one second; it grows with the square root of the time");
}

/// Estimates the covariance of every segment of a refined pose, as marginals of a Gaussian on the hand's tree. The
/// Gaussian combines the evidence of the frame (every patch of skin counts once), the joints that hold the segments
/// together, and the time that a hidden joint has had to move. One object follows one hand from frame to frame.
class PoseUncertainty {
 public:
  /// `energy`: the parameters with which the poses are refined.
  PoseUncertainty(const UncertaintyParams& params, const EnergyParams& energy);

  /// Call when another hand is tracked or the track starts again: joints that are not seen may then be anywhere.
  void restart();
  /// Call once per frame. `hidden[s]`: the pose of segment s was inferred from structure and motion, not from data;
  /// `dt`: time since the previous frame [s]. Returns the covariances of the boxplus twist (translation [m], rotation
  /// [rad]) in the camera frame.
  std::array<Matrix6d, kSegmentCount> covariance(const HandProfile& profile, const RefinedPose& refined,
                                                 const std::array<bool, kSegmentCount>& hidden, double dt);

 private:
  UncertaintyParams params_;
  EnergyParams energy_;
  std::array<double, kSegmentCount> hidden_for_;  // time since the segment was seen last [s]
};

/// Probability that a point whose error has the covariance `covariance` [m^2] is within `radius` [m] of the truth. The
/// squared error is a weighted sum of three squared normals, approximated by a gamma distribution of the same mean and
/// variance (Satterthwaite 1946).
double probability_within(double radius, const Eigen::Matrix3d& covariance);

}  // namespace barehand
