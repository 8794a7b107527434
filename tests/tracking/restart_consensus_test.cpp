#include "tracking/hypotheses/restart_consensus.h"

#include <gtest/gtest.h>

#include "support/adult_hand.h"

namespace barehand {
namespace {

class RestartConsensusTest : public ::testing::Test {
 protected:
  void add(double metres, double score) {
    HandPose pose = upright_;
    for (SE3& T : pose) T.t.x() += metres;
    found_.add(pose, score);
  }
  void add_settling(double metres, double score) {
    add(metres, score);
    EXPECT_TRUE(found_.converged());
  }
  void add_unsettled(int count, double metres, double score) {
    for (int i = 0; i < count; ++i) {
      add(metres, score);
      EXPECT_FALSE(found_.converged()) << i;
    }
  }

  const std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  const HandPose upright_ = test::facing_pose(*profile_, 0.5);
  RestartConsensus found_{*profile_, 0.0015, 0.004};
};

TEST_F(RestartConsensusTest, NothingIsNotConverged) { EXPECT_FALSE(found_.converged()); }

TEST_F(RestartConsensusTest, OneThatIsGoodEnoughSettlesIt) {
  add_unsettled(1, 0, 0.0016);
  add_settling(0.1, 0.0014);
}

TEST_F(RestartConsensusTest, TheBestOneFoundThreeTimesIsEnough) {
  add_unsettled(2, 0, 0.002);
  add_settling(0.004, 0.0021);
}

TEST_F(RestartConsensusTest, AWorseOneFoundThreeTimesIsNot) {
  add_unsettled(1, 0, 0.002);
  add_unsettled(5, 0.1, 0.0021);
}

TEST_F(RestartConsensusTest, ABetterOneIsToBeFoundAgain) {
  add_unsettled(2, 0, 0.002);
  add_unsettled(2, 0.1, 0.0019);
  add_settling(0.1, 0.0019);
}

TEST_F(RestartConsensusTest, EightOfWhichSevenDifferInFingersOnlyAreEnough) {
  add_unsettled(1, 0.5, 0.003);
  add_unsettled(1, 0, 0.002);
  for (int i = 1; i < 6; ++i) add_unsettled(1, 0.006 * i, 0.003);
  add_settling(0.036, 0.003);
}

TEST_F(RestartConsensusTest, EightThatExplainNothingAreEnough) {
  for (int i = 0; i < 7; ++i) add_unsettled(1, 0.1 * i, 0.005);
  add_settling(0.9, 0.005);
}

TEST_F(RestartConsensusTest, TwoElsewhereKeepTheSearchGoing) {
  add_unsettled(2, 0.5, 0.003);
  add_unsettled(1, 0, 0.002);
  for (int i = 1; i < 13; ++i) add_unsettled(1, 0.006 + 0.0025 * i, 0.003);
}

}  // namespace
}  // namespace barehand
