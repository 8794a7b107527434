#include "stages/search/initialiser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "stages/prediction/motion_prediction.h"
#include "support/point_world.h"

namespace barehand {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::uint64_t kSeed = 7;

void expect_equal(const std::vector<StartCandidate>& a, const std::vector<StartCandidate>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int s = 0; s < kSegmentCount; ++s) EXPECT_EQ(a[i].pose[s].matrix(), b[i].pose[s].matrix());
}

constexpr double kSkinCell = 0.004;

class InitialiserTest : public testing::Test {
 protected:
  void SetUp() override { use(test::adult_hand()); }
  void use(std::shared_ptr<const HandProfile> profile) {
    ASSERT_TRUE(profile);
    profile_ = profile;
    limits_ = widened_limits(*profile, 0.1);
    initialiser_ = std::make_unique<Initialiser>(profile, make_skin(*profile, kSkinCell), InitialiserParams{});
  }
  /// A pose similar to the template `index`, with the middle of the hand near the optical axis at a depth of 0.4 m.
  HandPose shape(std::size_t index, double roll, double in_plane) const {
    ArticulatedPose pose;
    pose.angles = shape_templates(*profile_, limits_)[index].angles;
    // Neither the shape nor the orientation is exactly that of a template.
    pose.angles[segment_of(1, 0)].flexion += 0.1;
    pose.angles[segment_of(3, 1)].flexion += 0.15;
    const Eigen::Matrix3d R = palm_orientation(roll + 0.1, 0.15, in_plane);
    pose.T_camera_palm = {R, Eigen::Vector3d(0.01, 0.01, 0.4) - R * Eigen::Vector3d(0, 0, -0.09)};
    return posed(*profile_, pose);
  }
  double error_of_best(const HandPose& truth) const {
    const auto starts =
        initialiser_->propose(*test::PointWorld(*profile_).observe(truth), Effort::full, kSeed, workers_);
    return starts.empty() ? 1.0 : test::mean_error(*profile_, starts.front().pose, truth);
  }

  std::shared_ptr<const HandProfile> profile_;
  std::array<JointLimits, kSegmentCount> limits_;
  std::unique_ptr<Initialiser> initialiser_;
  mutable Workers workers_{1};
};

TEST_F(InitialiserTest, FindsAnOpenHandAtAnyInPlaneRotation) {
  for (const double roll : {0.0, kPi}) {
    for (int k = 0; k < 6; ++k) {
      EXPECT_LT(error_of_best(shape(1, roll, 2 * kPi * k / 6 + 0.2)), 0.02) << "roll " << roll << ", rotation " << k;
    }
  }
}

TEST_F(InitialiserTest, FindsAHalfOpenHand) { EXPECT_LT(error_of_best(shape(2, 0.0, 1.0)), 0.025); }

TEST_F(InitialiserTest, FindsALeftHand) {
  use(test::adult_hand(Handedness::left));
  EXPECT_LT(error_of_best(shape(1, 0.0, 0.5)), 0.02);
}

TEST_F(InitialiserTest, RanksByCostAndReturnsDistinctPoses) {
  const auto starts =
      initialiser_->propose(*test::PointWorld(*profile_).observe(shape(1, 0, 0)), Effort::full, kSeed, workers_);
  ASSERT_GE(starts.size(), 2u);
  for (std::size_t i = 1; i < starts.size(); ++i) {
    EXPECT_LE(starts[i - 1].cost, starts[i].cost);
    for (std::size_t k = 0; k < i; ++k) EXPECT_GE(pose_distance(*profile_, starts[i].pose, starts[k].pose), 0.012);
  }
}

TEST_F(InitialiserTest, VariantsOfOnePoseLeaveRoomForPosesElsewhere) {
  const auto observation = test::PointWorld(*profile_).observe(shape(1, 0, 0));
  InitialiserParams params;
  const auto alone = [&] {  // proposals that are no variant of another one
    const auto starts = Initialiser(profile_, make_skin(*profile_, kSkinCell), params)
                            .propose(*observation, Effort::full, kSeed, workers_);
    EXPECT_EQ(starts.size(), static_cast<std::size_t>(params.results));
    return std::ranges::count_if(starts, [&](const StartCandidate& a) {
      return std::ranges::count_if(starts, [&](const StartCandidate& b) {
               return pose_distance(*profile_, a.pose, b.pose) < params.apart;
             }) == 1;  // itself
    });
  };
  EXPECT_GE(alone(), 4);
  params.full.distant_fraction = 0;
  EXPECT_LT(alone(), 4);
}

TEST_F(InitialiserTest, TheSameSeedGivesTheSamePosesOnAnyNumberOfCores) {
  const auto observation = test::PointWorld(*profile_).observe(shape(1, 0, 0.7));
  Workers three(3);
  const auto a = initialiser_->propose(*observation, Effort::quick, kSeed, workers_);
  const auto b = initialiser_->propose(*observation, Effort::quick, kSeed, three);
  const auto other = initialiser_->propose(*observation, Effort::quick, kSeed + 1, workers_);
  expect_equal(a, b);
  ASSERT_FALSE(other.empty());
  EXPECT_NE(a[0].cost, other[0].cost);
}

TEST_F(InitialiserTest, ReacquiresFromTheLastGoodPoseQuickly) {
  const HandPose truth = shape(5, 0.8, 0.4);
  const HandPose last = moved({exp_so3({0, 0, 0.7}), {0.02, -0.03, 0.02}}, truth);
  const auto starts = initialiser_->propose(*test::PointWorld(*profile_).observe(truth), Effort::quick, kSeed, workers_,
                                            HiddenCost::counted, &last);
  ASSERT_FALSE(starts.empty());
  EXPECT_EQ(starts.front().name, "last");
  EXPECT_LT(test::mean_error(*profile_, starts.front().pose, truth), 0.02);
}

TEST_F(InitialiserTest, FindsTheOneFingerThatIsElsewhereNearAFollowedPose) {
  const HandPose truth = shape(1, 0, 0.4);
  const auto observation = test::PointWorld(*profile_).observe(truth);
  for (const int finger : {0, 1, 3}) {
    ArticulatedPose followed = articulated_from(*profile_, truth, limits_);
    const auto& fist = shape_templates(*profile_, limits_)[5].angles;
    for (int k = 0; k < 3; ++k) followed.angles[segment_of(finger, k)] = fist[segment_of(finger, k)];
    const auto starts = initialiser_->propose_near(*observation, posed(*profile_, followed), kSeed, workers_);
    ASSERT_FALSE(starts.empty());
    const auto tip_error = [&](const HandPose& pose) {
      const int tip = segment_of(finger, 2);
      return (distal_end(*profile_, pose, tip) - distal_end(*profile_, truth, tip)).norm();
    };
    const double before = tip_error(posed(*profile_, followed));
    EXPECT_GT(before, 0.03) << "finger " << finger << " is to be wrong at first";
    EXPECT_LT(tip_error(starts.front().pose), 0.4 * before) << "finger " << finger;
    EXPECT_LT(test::mean_error(*profile_, starts.front().pose, truth), 0.01) << "finger " << finger;
  }
}

TEST_F(InitialiserTest, NearAFollowedPoseTheSameSeedGivesTheSamePosesOnAnyNumberOfCores) {
  const HandPose truth = shape(1, 0, 0.7);
  const auto observation = test::PointWorld(*profile_).observe(truth);
  Workers three(3);
  const auto a = initialiser_->propose_near(*observation, truth, kSeed, workers_);
  const auto b = initialiser_->propose_near(*observation, truth, kSeed, three);
  ASSERT_FALSE(a.empty());
  expect_equal(a, b);
}

TEST_F(InitialiserTest, ProposesNothingWithoutAHand) {
  const HandPose truth = shape(1, 0, 0);
  auto observation = test::PointWorld(*profile_).observe(truth);
  observation->hand_pixels.resize(50);
  EXPECT_TRUE(initialiser_->propose(*observation, Effort::full, kSeed, workers_).empty());
  EXPECT_TRUE(initialiser_->propose_near(*observation, truth, kSeed, workers_).empty());
}

TEST_F(InitialiserTest, ResultsObeyTheWidenedLimits) {
  const auto starts =
      initialiser_->propose(*test::PointWorld(*profile_).observe(shape(4, 0, 0)), Effort::quick, kSeed, workers_);
  const auto limits = widened_limits(*profile_, InitialiserParams{}.widening + 1e-6);
  for (const StartCandidate& start : starts) {
    for (int s = 1; s < kSegmentCount; ++s) {
      const JointAngles angles = joint_angles(*profile_, start.pose, s);
      EXPECT_GE(angles.flexion, limits[s].flexion_lo) << kSegmentNames[s];
      EXPECT_LE(angles.flexion, limits[s].flexion_hi) << kSegmentNames[s];
      EXPECT_LT(std::abs(angles.twist), 1e-6);
    }
  }
}

}  // namespace
}  // namespace barehand
