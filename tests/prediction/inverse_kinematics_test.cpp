#include "stages/prediction/inverse_kinematics.h"

#include <array>
#include <functional>
#include <random>
#include <vector>

#include "math/angles.h"
#include "stages/prediction/initialiser.h"
#include "support/rendered_person.h"

namespace barehand {
namespace {

class InverseKinematicsTest : public ::testing::Test {
 protected:
  /// A pose of `profile` with random angles within its limits, anywhere, turned anyhow.
  HandPose random_pose(const HandProfile& profile) {
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<double> normal;
    const auto limits = widened_limits(profile, 0);
    std::array<JointAngles, kSegmentCount> angles{};
    for (int s = 1; s < kSegmentCount; ++s) {
      angles[s].flexion = std::lerp(limits[s].flexion_lo, limits[s].flexion_hi, uniform(random_));
      angles[s].abduction = std::lerp(limits[s].abduction_lo, limits[s].abduction_hi, uniform(random_));
    }
    SE3 T;
    T.R = exp_so3(3 * Eigen::Vector3d(uniform(random_) - 0.5, uniform(random_) - 0.5, uniform(random_) - 0.5));
    T.t = {normal(random_) * 0.1, normal(random_) * 0.1, 0.6};
    return forward_kinematics(profile, T, angles);
  }
  DetectedJoints joints_of(const HandProfile& profile, const HandPose& pose, double deviation) {
    std::normal_distribution<double> normal(0, deviation);
    DetectedJoints joints;
    const auto points = test::landmarks(profile, pose);
    for (int k = 0; k < kLandmarkCount; ++k) {
      joints[k].position = points[k] + Eigen::Vector3d(normal(random_), normal(random_), normal(random_));
      joints[k].covariance = std::max(1e-6, deviation * deviation) * Eigen::Matrix3d::Identity();
    }
    return joints;
  }

  std::mt19937 random_{7};
  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
};

/// Largest relative difference between a component of the equations' gradient and a numeric one of their energy, over
/// all segments and the scale.
double gradient_error(const KinematicEquations& equations, const std::function<double(const HandPose&, double)>& energy,
                      const HandPose& pose, double scale) {
  constexpr double kStep = 1e-6, kNegligible = 1e-5;  // of the largest component
  std::vector<std::array<double, 2>> pairs;
  for (int s = 0; s < kSegmentCount; ++s)
    for (int i = 0; i < 6; ++i) {
      HandPose above = pose, below = pose;
      above[s] = boxplus(pose[s], kStep * Vector6d::Unit(i));
      below[s] = boxplus(pose[s], -kStep * Vector6d::Unit(i));
      pairs.push_back({equations.tree.g[s][i], (energy(below, scale) - energy(above, scale)) / (4 * kStep)});
    }
  const double by_scale = energy(pose, scale * std::exp(-kStep)) - energy(pose, scale * std::exp(kStep));
  pairs.push_back({equations.scale_gradient, by_scale / (4 * kStep)});

  double largest = 0, worst = 0;
  for (const auto& [gradient, numeric] : pairs) largest = std::max(largest, std::abs(numeric));
  for (const auto& [gradient, numeric] : pairs)
    worst = std::max(worst, std::abs(gradient - numeric) / std::max(std::abs(numeric), kNegligible * largest));
  return worst;
}

TEST_F(InverseKinematicsTest, TheGradientIsTheEnergysAndAWrongOneIsNoticed) {
  const auto limits = widened_limits(*profile_, 0);
  const DetectedJoints joints = joints_of(*profile_, random_pose(*profile_), 0.02);
  HandPose pose = random_pose(*profile_);
  for (SE3& T : pose) T = boxplus(T, 0.02 * Vector6d::Random());  // joints open and beyond their limits
  const auto energy = [&](const HandPose& p, double scale) {
    return kinematic_equations(*profile_, limits, joints, p, scale).energy;
  };
  KinematicEquations equations = kinematic_equations(*profile_, limits, joints, pose, 1.1);
  EXPECT_LT(gradient_error(equations, energy, pose, 1.1), 1e-2);

  KinematicEquations wrong = equations;
  wrong.tree.g[segment_of(1, 2)].tail<3>() *= -1;
  EXPECT_GT(gradient_error(wrong, energy, pose, 1.1), 0.1);
  wrong = equations;
  wrong.scale_gradient *= 1.5;
  EXPECT_GT(gradient_error(wrong, energy, pose, 1.1), 0.1);
}

TEST_F(InverseKinematicsTest, RecoversPosesFromExactJoints) {
  HandProfile measured = *profile_;
  measured.origin = ProfileOrigin::measured;
  for (int i = 0; i < 30; ++i) {
    const HandPose truth = random_pose(measured);
    const auto fit = fit_to_joints(measured, joints_of(measured, truth, 0));
    ASSERT_TRUE(fit);
    EXPECT_LT(pose_distance(measured, fit->pose, truth), 0.002) << i;
    EXPECT_EQ(fit->scale, 1);
  }
}

TEST_F(InverseKinematicsTest, JointsWithTheDetectionsNoiseGiveAPoseThatIsBetterThanThey) {
  double sum = 0;
  for (int i = 0; i < 30; ++i) {
    const HandPose truth = random_pose(*profile_);
    const auto fit = fit_to_joints(*profile_, joints_of(*profile_, truth, 0.007));  // 12 mm from the truth each
    ASSERT_TRUE(fit);
    sum += pose_distance(*profile_, fit->pose, truth) / 30;
  }
  EXPECT_LT(sum, 0.009);
}

TEST_F(InverseKinematicsTest, AMeanHandIsGivenTheDetectedSize) {
  const HandProfile child = scaled(*profile_, 0.8);
  const HandPose truth = random_pose(child);
  const auto fit = fit_to_joints(*profile_, joints_of(child, truth, 0));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->scale, 0.8, 0.01);
  for (int s = segment_of(1, 0); s < kSegmentCount; ++s)  // the thumb's angles are less well defined
    EXPECT_NEAR(joint_angles(*profile_, fit->pose, s).flexion, joint_angles(child, truth, s).flexion, 0.06);
  const auto middle = [](const HandProfile& hand, const HandPose& pose) -> Eigen::Vector3d {
    return pose[kPalm] * (0.5 * hand.segments[kPalm].distal);
  };
  EXPECT_LT((middle(*profile_, fit->pose) - middle(child, truth)).norm(), 0.003);
}

TEST_F(InverseKinematicsTest, OneJointThatIsWayOffHardlyMatters) {
  const HandPose truth = random_pose(*profile_);
  DetectedJoints joints = joints_of(*profile_, truth, 0.005);
  joints[landmark_of(1, 3)].position += Eigen::Vector3d(0.15, 0, 0);
  const auto fit = fit_to_joints(*profile_, joints);
  ASSERT_TRUE(fit);
  EXPECT_LT(pose_distance(*profile_, fit->pose, truth), 0.015);
}

TEST_F(InverseKinematicsTest, JointsOnOneSpotDefineNoPose) {
  DetectedJoints joints;
  for (DetectedJoint& joint : joints) joint = {{0, 0, 0.5}, 1e-4 * Eigen::Matrix3d::Identity()};
  EXPECT_FALSE(fit_to_joints(*profile_, joints));
}

}  // namespace
}  // namespace barehand
