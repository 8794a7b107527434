#include "stages/fusion/joint_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/angles.h"
#include "math/random.h"
#include "tests/fusion/small_hand.h"

namespace barehand {
namespace {

/// Eq. 4-6 literally, in double precision.
double reference_energy(const HandProfile& profile, const FusionParams& params, double sigma_prox, const HandPose& pose,
                        int s) {
  // The distance of an angle from its range, by the shorter way around the circle [rad].
  const JointLimits l = widened_limits(profile, params.limit_widening_deg * kDegree)[s];
  const JointAngles a = joint_angles(profile, pose, s);
  const auto error = [](double angle, double lo, double hi) {
    double nearest = INFINITY;
    for (int turn = -1; turn <= 1; ++turn) {
      const double x = angle + turn * 2 * std::numbers::pi;
      nearest = std::min(nearest, std::max({0.0, lo - x, x - hi}));
    }
    return nearest;
  };

  // The sum of all terms.
  const double prox = (joint_in_parent(profile, pose, s) - proximal_end(pose, s)).norm() / sigma_prox;
  const double flexion = error(a.flexion, l.flexion_lo, l.flexion_hi) / (params.sigma_flexion_deg * kDegree);
  const double abduction = error(a.abduction, l.abduction_lo, l.abduction_hi) / (params.sigma_abduction_deg * kDegree);
  const double twist = a.twist / (params.sigma_twist_deg * kDegree);
  return prox * prox + flexion * flexion + abduction * abduction + twist * twist;
}

FusionParams distinct_sigmas() {
  FusionParams params;
  params.sigma_flexion_deg = 12;
  params.sigma_abduction_deg = 7;
  params.sigma_twist_deg = 5;
  return params;
}

EdgeEnergy energy_of_all_pairs(const JointModel& joint, double sigma_prox, const std::vector<SE3>& parents,
                               const std::vector<SE3>& children) {
  ParentFrames frames;
  frames.reset(joint, parents);
  EdgeEnergy energy;
  joint_energy(joint, sigma_prox, frames, children, energy);
  return energy;
}

TEST(JointEnergy, AgreesWithTheEquationsInDoublePrecision) {
  const HandProfile profile = small_hand();
  const FusionParams params = distinct_sigmas();
  const JointModels models = make_joint_models(profile, params);
  KeyedRandom random(1, 2);

  // All pairs of random samples; the last child has angles beyond +-180 degrees, where they wrap around.
  for (const int s : {1, 4, 5}) {
    std::vector<SE3> parents, children;
    for (int i = 0; i < 9; ++i) {
      parents.push_back(random_pose(random, 0.02, 1.0));
      children.push_back(random_pose(random, 0.02, 1.0));
    }
    children.push_back(random_pose(random, 0.02, 3.1));

    // Compare every pair with the equations.
    const EdgeEnergy energy = energy_of_all_pairs(models[s], 0.005, parents, children);
    for (std::size_t c = 0; c < children.size(); ++c)
      for (std::size_t p = 0; p < parents.size(); ++p) {
        HandPose pose;
        pose[parent_of(s)] = parents[p];
        pose[s] = children[c];
        const double expected = reference_energy(profile, params, 0.005, pose, s);
        ASSERT_NEAR(energy.row(c)[p], expected, 1e-4 * (1 + expected)) << "segment " << s;
      }
  }
}

double energy_at(const JointAngles& angles, int s, const Eigen::Vector3d& gap = Eigen::Vector3d::Zero()) {
  const HandProfile profile = small_hand();
  std::array<JointAngles, kSegmentCount> all{};
  all[s] = angles;
  HandPose pose = forward_kinematics(profile, SE3{Eigen::Matrix3d::Identity(), {0, 0, 0.5}}, all);
  pose[s].t += gap;
  const auto models = make_joint_models(profile, distinct_sigmas());
  return energy_of_all_pairs(models[s], 0.005, {pose[parent_of(s)]}, {pose[s]}).value[0];
}

TEST(JointEnergy, IsZeroWithinTheWidenedLimitsOfAClosedJoint) {
  EXPECT_NEAR(energy_at({80 * kDegree, 15 * kDegree, 0}, 4), 0, 1e-6);
  EXPECT_NEAR(energy_at({99 * kDegree, 0, 0}, 4), 0, 1e-6);  // 90 + 10 of widening
}

TEST(JointEnergy, CountsOneSigmaAsOne) {
  EXPECT_NEAR(energy_at({}, 4, {0, 0.005, 0}), 1, 1e-4);                 // sigma_prox
  EXPECT_NEAR(energy_at({(100 + 12) * kDegree, 0, 0}, 4), 1, 1e-3);      // beyond the flexion limit
  EXPECT_NEAR(energy_at({0, -(20 + 10 + 7) * kDegree, 0}, 4), 1, 1e-3);  // beyond the abduction limit
  EXPECT_NEAR(energy_at({0, 0, 5 * kDegree}, 4), 1, 1e-3);               // any twist counts
}

TEST(JointEnergy, AHingeHasNoFreeAbduction) { EXPECT_NEAR(energy_at({0.5, 7 * kDegree, 0}, 5), 1, 1e-3); }

}  // namespace
}  // namespace barehand
