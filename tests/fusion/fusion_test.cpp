#include "stages/fusion/fusion.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "stages/fusion/mode.h"
#include "tests/fusion/small_hand.h"

namespace barehand {
namespace {

const SE3 kPalmPose{Eigen::Matrix3d::Identity(), {0, 0, 0.5}};

HandPose flexed_hand(double flexion) {
  std::array<JointAngles, kSegmentCount> angles{};
  for (int s = 1; s < kSegmentCount; ++s) angles[s].flexion = flexion;
  return forward_kinematics(small_hand(), kPalmPose, angles);
}

/// Samples of every segment: the given pose and `count - 1` displaced ones, all equally likely.
SegmentSamples flat_samples(const HandPose& pose, int count) {
  KeyedRandom random(5, 1);
  SegmentSamples samples;
  for (int s = 0; s < kSegmentCount; ++s) {
    samples.poses[s] = {pose[s]};
    for (int i = 1; i < count; ++i) {
      Vector6d twist;
      for (double& x : twist) x = random.uniform(-1, 1);
      twist.head<3>() *= 0.01;
      twist.tail<3>() *= 0.3;
      samples.poses[s].push_back(boxplus(pose[s], twist));
    }

    samples.log_likelihood[s].assign(count, 0.0);
  }
  return samples;
}

Fusion make_fusion(Workers& workers, const FusionParams& params = {}) {
  return Fusion(params, std::make_shared<HandProfile>(small_hand()), workers);
}

std::size_t best(const std::vector<double>& v) { return std::max_element(v.begin(), v.end()) - v.begin(); }

TEST(Fusion, StructureAloneFindsTheClosedHand) {
  // Only the palm and the fingertips are observed, at sample 0. All other segments have a flat likelihood (fully
  // occluded) and must follow.
  Workers workers(1);
  Fusion fusion = make_fusion(workers);
  SegmentSamples samples = flat_samples(flexed_hand(0.4), 40);
  for (int s = 0; s < kSegmentCount; ++s)
    if (s == kPalm || is_tip(s))
      for (std::size_t i = 1; i < samples.poses[s].size(); ++i) samples.log_likelihood[s][i] = -50;
  const HandBelief belief = fusion.fuse(samples, 0);
  for (int s = 0; s < kSegmentCount; ++s) EXPECT_EQ(best(belief.log_belief[s]), 0u) << kSegmentNames[s];
}

TEST(Fusion, LaterLevelsHoldTheJointsTighter) {
  Workers workers(1);
  Fusion fusion = make_fusion(workers);
  const SegmentSamples samples = flat_samples(flexed_hand(0.4), 30);
  const int last = fusion.params().levels - 1;
  const HandBelief tight = fusion.fuse(samples, last), loose = fusion.fuse(samples, 0);
  EXPECT_GT(tight.log_belief[kPalm][0], loose.log_belief[kPalm][0]);
}

TEST(Fusion, ResultDoesNotDependOnTheNumberOfWorkers) {
  Workers one(1), four(4);
  const SegmentSamples samples = flat_samples(flexed_hand(0.4), 30);
  const HandBelief a = make_fusion(one).fuse(samples, 1), b = make_fusion(four).fuse(samples, 1);
  EXPECT_EQ(a.log_belief, b.log_belief);
}

TEST(Fusion, FirstProposalsAreOneBoxAtThePredictionThatGrowsWithTheInterval) {
  Workers workers(1);
  Fusion fusion = make_fusion(workers);
  const HandPose pose = flexed_hand(0.2);
  const Proposals nominal = fusion.first_proposals(pose), late = fusion.first_proposals(pose, 2);
  for (int s = 0; s < kSegmentCount; ++s) {
    ASSERT_EQ(nominal[s].size(), 1u);
    EXPECT_EQ(nominal[s][0].T_camera_segment.t, pose[s].t);
    EXPECT_TRUE(late[s][0].half_width.isApprox(2 * nominal[s][0].half_width));
  }
  EXPECT_NEAR(nominal[4][0].half_width[3], 25 * M_PI / 180, 1e-12);
  EXPECT_NEAR(nominal[4][0].half_width[4], 8 * M_PI / 180, 1e-12);
}

TEST(Fusion, NextProposalsAreTheBestSamplesInShrinkingBoxes) {
  Workers workers(1);
  FusionParams params;
  params.kernels = 3;
  params.levels = 4;
  params.kernel_separation = 0;
  Fusion fusion = make_fusion(workers, params);

  // Set beliefs with a given order.
  const SegmentSamples samples = flat_samples(flexed_hand(0.2), 6);
  HandBelief belief;
  for (auto& b : belief.log_belief) b = {-5, -1, -9, -2, -3, -4};

  // The best three samples come first, and the boxes shrink.
  const Proposals next = fusion.next_proposals(samples, belief, 2);
  const Vector6d first = fusion.first_proposals(flexed_hand(0.2))[7][0].half_width;
  ASSERT_EQ(next[7].size(), 3u);
  EXPECT_EQ(next[7][0].T_camera_segment.t, samples.poses[7][1].t);
  EXPECT_EQ(next[7][1].T_camera_segment.t, samples.poses[7][3].t);
  EXPECT_EQ(next[7][2].T_camera_segment.t, samples.poses[7][4].t);
  EXPECT_TRUE(next[7][0].half_width.isApprox(params.range_end * first));  // level 3 is the last
  EXPECT_LT(fusion.next_proposals(samples, belief, 0)[7][0].half_width[0], first[0]);
}

TEST(Fusion, ReadOutAveragesTheBestModeOnly) {
  Workers workers(1);
  Fusion fusion = make_fusion(workers);

  // Two close samples form the best mode; one is far away.
  SegmentSamples samples;
  HandBelief belief;
  for (int s = 0; s < kSegmentCount; ++s) {
    SE3 a = kPalmPose, b = kPalmPose, far = kPalmPose;
    b.t.x() += 0.002;
    b.R = exp_so3({0.1, 0, 0});
    far.t.x() += 0.1;
    samples.poses[s] = {a, b, far};
    belief.log_belief[s] = {std::log(0.4), std::log(0.4), std::log(0.2)};
  }

  // The mean is that of the mode.
  const FusedPose fused = fusion.read_out(samples, belief);
  EXPECT_NEAR(fused.pose[3].t.x(), 0.001, 1e-9);
  EXPECT_NEAR(log_so3(fused.pose[3].R).x(), 0.05, 1e-9);

  FusionParams params;
  params.read_out = "max";
  EXPECT_EQ(make_fusion(workers, params).read_out(samples, belief).pose[3].t, kPalmPose.t);
}

TEST(Fusion, CovarianceIsThatOfTheBeliefInTheCameraFrame) {
  Workers workers(1);
  FusionParams params;
  params.range_end = 0.001;  // makes the resolution term of the covariance negligible
  Fusion fusion = make_fusion(workers, params);

  // Two samples on the camera's y axis.
  SegmentSamples samples;
  HandBelief belief;
  for (int s = 0; s < kSegmentCount; ++s) {
    SE3 a = kPalmPose, b = kPalmPose;
    a.t.y() -= 0.001;
    b.t.y() += 0.001;
    samples.poses[s] = {a, b};
    belief.log_belief[s] = {std::log(0.5), std::log(0.5)};
  }

  // The variance is along this axis.
  const Matrix6d covariance = fusion.read_out(samples, belief).covariance[5];
  EXPECT_NEAR(covariance(1, 1), 1e-6, 1e-9);
  EXPECT_LT(covariance(0, 0), 1e-9);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(covariance).eigenvalues().minCoeff(), 0);
}

TEST(BestDistinct, SkipsSamplesTooNearAnEarlierChoice) {
  std::vector<SE3> poses(3);
  poses[1].t.x() = 0.001;
  poses[2].t.x() = 0.02;
  Vector6d half_width = Vector6d::Constant(0.01);
  EXPECT_EQ(DistinctChoice().best(poses, {0, -1, -2}, 2, half_width, 0.5), (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(DistinctChoice().best(poses, {0, -1, -2}, 2, half_width, 0), (std::vector<std::size_t>{0, 1}));
}

TEST(BestDistinct, KeepsTheOrderOfEqualBeliefs) {
  EXPECT_EQ(DistinctChoice().best(std::vector<SE3>(4), {-1, -1, -1, -1}, 2, Vector6d::Ones(), 0),
            (std::vector<std::size_t>{0, 1}));
}

}  // namespace
}  // namespace barehand
