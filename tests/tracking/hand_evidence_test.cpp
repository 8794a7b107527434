#include "tracking/hypotheses/hand_evidence.h"

#include <gtest/gtest.h>

#include "support/painted_hand.h"
#include "support/rendered_person.h"

namespace barehand {
namespace {

constexpr double kLots = 0.4;  // a difference of log odds that is significant

const Eigen::Vector3d kHere(0, 0, 0.6);

/// A hand whose joints are detected at their true positions.
class EvidenceOfPose : public testing::TestWithParam<Handedness> {
 protected:
  const std::shared_ptr<const HandProfile> profile_ = test::adult_hand(GetParam());
  const HandPose pose_ = test::facing_pose(*profile_, 0.5, 0.3);
  DetectedHand detected() const {
    return test::detected_hand(*profile_, pose_, GetParam() == Handedness::right ? 3 : -3, 0.01);
  }
};

INSTANTIATE_TEST_SUITE_P(Sides, EvidenceOfPose, testing::Values(Handedness::right, Handedness::left));

TEST_P(EvidenceOfPose, APoseCountsThatExplainsTheDataAtTheJoints) {
  RefinedPose refined;
  refined.pose = pose_;
  refined.score = 0.002;
  refined.matched.fill(0.8);
  const double good = log_odds_of_pose(refined, *profile_, detected());

  RefinedPose bad = refined, elsewhere = refined;
  bad.score = 0.006;
  for (SE3& T : elsewhere.pose) T.t.x() += 0.04;
  EXPECT_LT(log_odds_of_pose(bad, *profile_, detected()), good - kLots);
  EXPECT_LT(log_odds_of_pose(elsewhere, *profile_, detected()), good - kLots);

  RefinedPose unseen = elsewhere;
  unseen.matched.fill(0);
  EXPECT_GT(log_odds_of_pose(unseen, *profile_, detected()), log_odds_of_pose(elsewhere, *profile_, detected()) + kLots)
      << "joints that are not seen may be anywhere";
}

TEST_P(EvidenceOfPose, WhereOnlySkinIsSeenTheJointsCountAndNotTheScore) {
  DetectedHand seen = detected();
  seen.skin_only = true;
  RefinedPose refined;
  refined.pose = pose_;
  refined.score = 0.002;
  refined.matched.fill(0.8);
  const double good = log_odds_of_pose(refined, *profile_, seen);
  RefinedPose bad = refined, elsewhere = refined;
  bad.score = 0.006;
  for (SE3& T : elsewhere.pose) T.t.x() += 0.04;
  EXPECT_EQ(log_odds_of_pose(bad, *profile_, seen), good);
  EXPECT_LT(log_odds_of_pose(elsewhere, *profile_, seen), good - 1.5);
}

TEST(HandEvidence, OneFrameCountsAsItIs) {
  HandEvidence evidence;
  EXPECT_EQ(evidence.add(1, kHere, 5), 5);
  EXPECT_EQ(HandEvidence().add(1, kHere, -5), -5);
}

TEST(HandEvidence, GrowsOverFramesButLessThanTheirSum) {
  HandEvidence evidence;
  double last = 0, total = 0;
  for (int frame = 1; frame <= 10; ++frame) {
    total = evidence.add(frame, kHere, 1);
    EXPECT_GT(total, last);
    last = total;
  }
  EXPECT_GT(total, 1.2);
  EXPECT_LT(total, 2);
}

TEST(HandEvidence, AFrameCountsOnceHoweverOftenItIsLookedAt) {
  HandEvidence once, often;
  for (int frame = 1; frame <= 3; ++frame) {
    const double total = once.add(frame, kHere, 1);
    often.add(frame, kHere, 1);
    EXPECT_EQ(often.add(frame, kHere, 1), total);
  }
}

TEST(HandEvidence, AFrameAgainstAHandTakesBackWhatWasForIt) {
  HandEvidence evidence;
  for (int frame = 1; frame <= 5; ++frame) evidence.add(frame, kHere, 1);
  evidence.add(6, kHere, -10);
  EXPECT_EQ(evidence.add(7, kHere, 1), 1);
}

TEST(HandEvidence, FadesOverFramesWithoutADetection) {
  HandEvidence evidence;
  for (int frame = 1; frame <= 5; ++frame) evidence.add(frame, kHere, 1);
  EXPECT_NEAR(evidence.add(105, kHere, 1), 1, 1e-3);
}

TEST(HandEvidence, WhatIsSeenElsewhereIsSomethingNew) {
  HandEvidence evidence;
  for (int frame = 1; frame <= 5; ++frame) evidence.add(frame, kHere, 1);
  EXPECT_EQ(evidence.add(6, kHere + Eigen::Vector3d(0.2, 0, 0), 1), 1);
}

const Eigen::Vector3d kThere = kHere + Eigen::Vector3d(0.2, 0, 0);

TEST(HandEvidence, GrowsAtEachOfTwoPlacesAsAtOneAlone) {
  HandEvidence both, here, there;
  for (int frame = 0; frame < 5; ++frame) {
    EXPECT_EQ(both.add(frame, kHere, 1), here.add(frame, kHere, 1));
    EXPECT_EQ(both.add(frame, kThere, 2), there.add(frame, kThere, 2));
    EXPECT_EQ(both.add(frame, kHere, 1), here.add(frame, kHere, 1)) << "looked at once more";
  }
}

TEST(HandEvidence, FollowsWhatMoves) {
  HandEvidence still, moving;
  for (int frame = 0; frame < 5; ++frame)
    EXPECT_EQ(moving.add(frame, kHere + Eigen::Vector3d(0.06 * frame, 0, 0), 1), still.add(frame, kHere, 1));
}

TEST(HandEvidence, WhatIsForgottenAtOnePlaceIsKeptAtAnother) {
  HandEvidence both, there;
  for (int frame = 0; frame < 5; ++frame) {
    both.add(frame, kHere, 1);
    both.add(frame, kThere, 1);
    there.add(frame, kThere, 1);
  }
  both.forget(kHere + Eigen::Vector3d(0.02, 0, 0));
  EXPECT_EQ(both.add(5, kHere, 1), 1);
  EXPECT_EQ(both.add(5, kThere, 1), there.add(5, kThere, 1));
}

}  // namespace
}  // namespace barehand
