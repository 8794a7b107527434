#include "stages/search/inverse_kinematics.h"

#include <random>

#include "math/angles.h"
#include "stages/search/initialiser.h"
#include "support/rendered_person.h"

namespace barehand {
namespace {

double square(double x) { return x * x; }

class InverseKinematicsTest : public ::testing::Test {
 protected:
  /// A pose of `profile` with random angles within its limits and a random position and orientation.
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

/// Largest relative difference between the equations' gradient and the numeric gradient of their energy. Translations,
/// rotations and the scale are compared separately, since their gradients have different units.
double gradient_error(const KinematicEquations& equations, const std::function<double(const HandPose&, double)>& energy,
                      const HandPose& pose, double scale) {
  constexpr double kStep = 1e-6;
  double worst = 0;
  for (int s = 0; s < kSegmentCount; ++s)
    for (int part = 0; part < 2; ++part) {
      Eigen::Vector3d numeric;  // of minus half the energy
      for (int i = 0; i < 3; ++i) {
        HandPose above = pose, below = pose;
        above[s] = boxplus(pose[s], kStep * Vector6d::Unit(3 * part + i));
        below[s] = boxplus(pose[s], -kStep * Vector6d::Unit(3 * part + i));
        numeric[i] = -0.5 * (energy(above, scale) - energy(below, scale)) / (2 * kStep);
      }
      worst = std::max(worst, (equations.tree.g[s].segment<3>(3 * part) - numeric).norm() / numeric.norm());
    }
  const double of_scale =
      -0.5 * (energy(pose, scale * std::exp(kStep)) - energy(pose, scale * std::exp(-kStep))) / (2 * kStep);
  return std::max(worst, std::abs(equations.scale_gradient - of_scale) / std::abs(of_scale));
}

TEST_F(InverseKinematicsTest, TheGradientIsTheEnergysAndAWrongOneIsNoticed) {
  const auto limits = widened_limits(*profile_, 0);
  const DetectedJoints joints = joints_of(*profile_, random_pose(*profile_), 0.02);
  HandPose pose = random_pose(*profile_);
  std::uniform_real_distribution<double> shift(-0.02, 0.02);
  for (SE3& T : pose) {  // separates the joints and moves them beyond their limits
    Vector6d step;
    for (double& x : step) x = shift(random_);
    T = boxplus(T, step);
  }
  const auto energy = [&](const HandPose& p, double scale) {
    return kinematic_equations(*profile_, limits, joints, p, scale).energy;
  };
  KinematicEquations equations = kinematic_equations(*profile_, limits, joints, pose, 1.1);
  EXPECT_LT(gradient_error(equations, energy, pose, 1.1), 1e-4);

  KinematicEquations wrong = equations;
  wrong.tree.g[segment_of(1, 2)].tail<3>() *= -1;
  EXPECT_GT(gradient_error(wrong, energy, pose, 1.1), 1e-3);
  wrong = equations;
  wrong.scale_gradient *= 1.5;
  EXPECT_GT(gradient_error(wrong, energy, pose, 1.1), 1e-3);
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
    const auto fit = fit_to_joints(*profile_, joints_of(*profile_, truth, 0.007));  // each joint is off by 12 mm
    ASSERT_TRUE(fit);
    sum += pose_distance(*profile_, fit->pose, truth) / 30;
  }
  EXPECT_LT(sum, 0.009);
}

TEST_F(InverseKinematicsTest, TheDetectedSizeOfAMeasuredHandIsFittedWhereItIsAskedFor) {
  HandProfile measured = *profile_;
  measured.origin = ProfileOrigin::measured;
  for (const double size : {0.5, 0.8, 1.0, 1.25, 2.0}) {
    const HandProfile seen = scaled(measured, size);
    DetectedJoints joints = joints_of(seen, random_pose(seen), 0);
    for (DetectedJoint& joint : joints) joint.covariance = square(0.005) * Eigen::Matrix3d::Identity();
    const auto fit = fit_size_to_joints(measured, joints, 0.4);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->scale, size, 0.04 * size);
  }
}

TEST_F(InverseKinematicsTest, AMeanHandIsGivenTheDetectedSize) {
  const HandProfile child = scaled(*profile_, 0.8);
  const HandPose truth = random_pose(child);
  DetectedJoints joints = joints_of(child, truth, 0);
  for (DetectedJoint& joint : joints) joint.covariance = square(0.003) * Eigen::Matrix3d::Identity();
  const auto fit = fit_to_joints(*profile_, joints);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->scale, 0.8, 0.01);
  double apart = 0;  // error of the flexions [rad]; a weak prior pulls them to those of the neutral pose
  for (int s = 1; s < kSegmentCount; ++s)
    apart += std::abs(joint_angles(*profile_, fit->pose, s).flexion - joint_angles(child, truth, s).flexion) / 15;
  EXPECT_LT(apart, 0.1);
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

TEST_F(InverseKinematicsTest, TheCostOfAPoseIsThatOfItsEquations) {
  for (int i = 0; i < 10; ++i) {
    const HandPose pose = random_pose(*profile_);
    const DetectedJoints joints = joints_of(*profile_, pose, 0.01);
    const auto equations = kinematic_equations(*profile_, widened_limits(*profile_, 0), joints, pose, 1);
    EXPECT_NEAR(joint_cost(*profile_, pose, joints), equations.cost, 1e-9);

    // A finger in another place costs more.
    DetectedJoints moved = joints;
    moved[landmark_of(3, 3)].position += Eigen::Vector3d(0.03, 0, 0);
    EXPECT_GT(joint_cost(*profile_, pose, moved), joint_cost(*profile_, pose, joints)) << i;
  }
}

}  // namespace
}  // namespace barehand
