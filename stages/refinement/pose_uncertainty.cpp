#include "stages/refinement/pose_uncertainty.h"

#include <cmath>
#include <limits>
#include <unsupported/Eigen/SpecialFunctions>

#include "hand/joint_linearisation.h"
#include "math/angles.h"
#include "math/square.h"

namespace barehand {
namespace {

// Computes the covariances of the segments of a refined pose.

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNeverSeen = std::numeric_limits<double>::infinity();
constexpr double kRangeDeviation = 0.2887;  // standard deviation of a uniform distribution over a range of 1
constexpr double kAnywhere = 1.0;           // standard deviation of the pose of a palm that no data shows [m, rad]

// Standard deviations of flexion, abduction and twist about their estimates [rad]; `hidden_for`: time without data
// [s]; `beyond`: fraction of the segment beyond the border of the image. What hides a segment inside the image is held
// by the hand or in its way; beyond the border, it moves twice as far.
Vector3d spread(const UncertaintyParams& p, const EnergyParams& energy, const JointLimits& limits, double hidden_for,
                double beyond) {
  const double twist = energy.sigma_angle_deg * kDegree;
  const double freedom = 1 + beyond;
  const double moved = freedom * std::hypot(p.just_hidden_deg, p.growth_deg * std::sqrt(hidden_for)) * kDegree;
  const double share = freedom * p.range_share * kRangeDeviation;
  const double flexion = std::min(moved, share * (limits.flexion_hi - limits.flexion_lo));
  const double abduction = std::min(moved, share * (limits.abduction_hi - limits.abduction_lo));
  return {std::max(flexion, twist), std::max(abduction, twist), twist};
}

// Adds the constraints that the joint's ends meet (within `sigma_gap` [m]) and that its angles are as estimated to
// within `deviation` [rad].
void hold_joint(const JointLinearisation& joint, int s, const Vector3d& deviation, double sigma_gap,
                GaussianTree& tree) {
  const Vector3d zero = Vector3d::Zero();
  const JointJacobians J_gap = joint.of_gap(), J_angles = joint.of_angles();
  tree.add<3>(s, J_gap.child, J_gap.parent, zero, Matrix3d::Identity() / square(sigma_gap));
  tree.add<3>(s, J_angles.child, J_angles.parent, zero, deviation.cwiseAbs2().cwiseInverse().asDiagonal());
}

}  // namespace

PoseUncertainty::PoseUncertainty(const UncertaintyParams& params, const EnergyParams& energy)
    : params_(params), energy_(energy) {
  restart();
}

void PoseUncertainty::restart() { hidden_for_.fill(kNeverSeen); }

std::array<Matrix6d, kSegmentCount> PoseUncertainty::covariance(const HandProfile& profile, const RefinedPose& refined,
                                                                const std::array<bool, kSegmentCount>& hidden,
                                                                double dt) {
  // The skin's deviation depends on how well the profile describes the person.
  const double factor = (profile.origin == ProfileOrigin::measured ? 1.0 : params_.mean_hand_factor) *
                        (profile.scanned_skin ? params_.scanned_factor : 1.0);

  // Within a patch of skin the model's error is common to all pixels, so a patch counts as one measurement with the
  // deviation of the skin instead of that of a pixel.
  const double scale = kReferenceArea / square(params_.skin_patch) * square(energy_.sigma_depth) /
                       square(factor * params_.skin_deviation);
  GaussianTree tree = refined.evidence;
  for (int s = 0; s < kSegmentCount; ++s) {
    tree.H_self[s] *= scale;
    tree.H_parent[s] *= scale;
  }

  // A palm without data may be anywhere; every other segment is held by its joint.
  tree.H_self[kPalm].diagonal().array() += 1 / square(kAnywhere);
  const auto limits = widened_limits(profile, energy_.limit_widening_deg * kDegree);
  for (int s = 1; s < kSegmentCount; ++s) {
    // What an object holds has not moved since it was seen.
    const bool moves = hidden[s] && !refined.holds[finger_of(s)].firm();
    hidden_for_[s] = moves ? hidden_for_[s] + dt : 0;
    // A visible segment is held by its data alone, so its joint is left free over its range.
    const Vector3d deviation =
        spread(params_, energy_, limits[s], hidden[s] ? hidden_for_[s] : kNeverSeen, hidden[s] ? refined.beyond[s] : 0);
    const JointLinearisation joint = linearise_joint(profile, refined.pose, s);
    hold_joint(joint, s, deviation, energy_.sigma_gap, tree);
  }

  // Compute the marginal covariances, and add, for every segment, the uncertainty of where its joint lies inside the
  // skin, which the data do not show.
  std::array<Matrix6d, kSegmentCount> covariance;
  if (!tree.marginals(covariance)) covariance.fill(Matrix6d::Identity() * square(kAnywhere));
  for (Matrix6d& c : covariance) c.topLeftCorner<3, 3>().diagonal().array() += square(factor * params_.joint_deviation);
  return covariance;
}

double probability_within(double radius, const Matrix3d& covariance) {
  const double mean = covariance.trace(), spread = covariance.squaredNorm();
  if (!(mean > 0)) return 1;
  const double degrees = square(mean) / spread;  // degrees of freedom
  return Eigen::numext::igamma(degrees / 2, square(radius) * mean / (2 * spread));
}

}  // namespace barehand
