#include "stages/refinement/pose_uncertainty.h"

#include "math/random.h"
#include "support/painted_hand.h"

namespace barehand {
namespace {

constexpr int kTip = segment_of(2, 2);

class PoseUncertaintyTest : public ::testing::Test {
 protected:
  /// A refined pose, started at the truth; if `covered`, a board hides all fingers.
  RefinedPose refined(bool covered) const {
    const HandPose truth = test::facing_pose(*profile_, 0.45, 0.2);
    auto observation = test::observe_skin(*skin_, truth);
    for (int v = 0; covered && v < 130; ++v)
      for (int u = 0; u < 320; ++u) {
        observation->label.at(u, v) = PixelLabel::object;
        observation->depth.at(u, v) = 0.3f;
      }
    return refinement_.refine(*observation, truth, truth, 5);
  }
  /// Root mean square of the stated error of the middle finger's tip [m]. Segments that the refinement hardly matched
  /// count as hidden.
  double tip_deviation(const RefinedPose& pose, double dt = 1.0 / 30) {
    std::array<bool, kSegmentCount> hidden;
    for (int s = 0; s < kSegmentCount; ++s) hidden[s] = pose.matched[s] < 0.15;
    const auto covariance = uncertainty_.covariance(*profile_, pose, hidden, dt);
    const auto J = point_jacobian(pose.pose[kTip].R * profile_->segments[kTip].distal);
    return std::sqrt((J * covariance[kTip] * J.transpose()).trace());
  }
  std::shared_ptr<HandProfile> profile_ = std::make_shared<HandProfile>(*test::adult_hand());
  std::shared_ptr<const Skin> skin_ = std::make_shared<Skin>(make_blended_skin(*profile_, 0.004));
  Refinement refinement_{RefinementParams{}, profile_, skin_};
  UncertaintyParams params_;
  PoseUncertainty uncertainty_{params_, EnergyParams{}};
  const RefinedPose open_ = refined(false), covered_ = refined(true);
};

TEST_F(PoseUncertaintyTest, AFingerInViewIsKnownToMillimetres) {
  profile_->origin = ProfileOrigin::measured;
  const double measured = tip_deviation(open_);
  EXPECT_GT(measured, std::sqrt(3) * params_.joint_deviation);
  EXPECT_LT(measured, 0.003);
  profile_->origin = ProfileOrigin::mean;
  const double mean = tip_deviation(open_);
  EXPECT_NEAR(mean, params_.mean_hand_factor * measured, 0.2 * params_.mean_hand_factor * measured);
  profile_->scanned_skin = skin_;
  EXPECT_NEAR(tip_deviation(open_), params_.scanned_factor * mean, 0.05 * mean);
}

TEST_F(PoseUncertaintyTest, AHiddenFingerIsKnownTheLessTheLongerItIsHidden) {
  profile_->origin = ProfileOrigin::measured;
  const double seen = tip_deviation(open_), hidden = tip_deviation(covered_);
  EXPECT_GT(hidden, 1.5 * seen);

  // The deviation grows while the finger is hidden ...
  double last = hidden;
  for (int i = 0; i < 3; ++i) {
    const double later = tip_deviation(covered_, 0.1);
    EXPECT_GT(later, last);
    last = later;
  }

  // ... up to that of the joint's range, and shrinks when the finger is seen again.
  tip_deviation(covered_, 1e6);
  const double longest = tip_deviation(covered_, 1);
  EXPECT_NEAR(tip_deviation(covered_, 1e6), longest, 1e-9) << "no further than the joint's range";
  EXPECT_LT(longest, 0.06);
  EXPECT_LT(tip_deviation(open_), 1.1 * seen) << "seen again";
}

TEST_F(PoseUncertaintyTest, AFingerBeyondTheBorderMovesFartherThanOneThatIsCovered) {
  const double seen = tip_deviation(open_), covered = tip_deviation(covered_);
  RefinedPose beyond = covered_;
  beyond.beyond.fill(1);
  tip_deviation(open_);
  EXPECT_GT(tip_deviation(beyond), 1.3 * covered);

  // What is seen of a finger counts as before.
  beyond = open_;
  beyond.beyond.fill(0.5);
  EXPECT_NEAR(tip_deviation(beyond), seen, 1e-9);
}

TEST_F(PoseUncertaintyTest, NothingIsKnownOfAFingerThatWasNeverSeen) {
  tip_deviation(open_);
  const double just_hidden = tip_deviation(covered_);
  uncertainty_.restart();
  EXPECT_GT(tip_deviation(covered_), 1.4 * just_hidden);
}

TEST_F(PoseUncertaintyTest, APoseWithoutEvidenceIsAnywhere) {
  RefinedPose none;
  none.pose = open_.pose;
  none.evidence.set_zero();
  EXPECT_GT(tip_deviation(none), 0.5);
}

TEST(ProbabilityWithin, AgreesWithDraws) {
  KeyedRandom random(1, 2);

  // Several covariances, among them that of a very flat distribution.
  for (const Eigen::Vector3d& deviations : {Eigen::Vector3d(0.004, 0.004, 0.004), Eigen::Vector3d(0.002, 0.005, 0.011),
                                            Eigen::Vector3d(0.0001, 0.0001, 0.02)}) {
    const Eigen::Matrix3d turn = exp_so3({0.3, -0.8, 0.5});
    const Eigen::Matrix3d covariance = turn * deviations.cwiseAbs2().asDiagonal() * turn.transpose();

    // Compare with the fraction of random errors within the radius.
    int within = 0;
    constexpr int kDraws = 20000;
    for (int i = 0; i < kDraws; ++i) {
      const Eigen::Vector3d z(random.normal(), random.normal(), random.normal());
      within += z.cwiseProduct(deviations).norm() <= 0.010;
    }
    EXPECT_NEAR(probability_within(0.010, covariance), static_cast<double>(within) / kDraws, 0.02);
  }
}

TEST(ProbabilityWithin, OfWhatIsExactIsOne) { EXPECT_EQ(probability_within(0.010, Eigen::Matrix3d::Zero()), 1); }

}  // namespace
}  // namespace barehand
