#include "tracking/usual_score.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

TEST(UsualScore, FallsFastAndRisesSlowly) {
  UsualScore usual;
  usual.update(0.004);
  for (int i = 0; i < 15; ++i) usual.update(0.002);
  EXPECT_NEAR(usual.level(), 0.002, 0.0001);
  for (int i = 0; i < 15; ++i) usual.update(0.004);
  EXPECT_LT(usual.level(), 0.0024) << "half a second of worse frames must still stand out";
  for (int i = 0; i < 600; ++i) usual.update(0.004);
  EXPECT_NEAR(usual.level(), 0.004, 0.0001) << "but what stays so is usual";
}

TEST(UsualScore, AFirstScoreIsNotYetUsual) {
  UsualScore usual;
  for (int i = 0; i < 10; ++i) usual.update(0.004);
  EXPECT_LT(usual.level(), 0.004 / 1.2) << "the hand may have been found in a wrong pose";
  for (int i = 0; i < 100; ++i) usual.update(0.004);
  EXPECT_GT(usual.level(), 0.004 / 1.15) << "but a hand that no search improves is not searched for ever";
}

TEST(UsualScore, StartsAnewAfterAReset) {
  UsualScore usual, fresh;
  usual.update(0.001);
  usual.reset();
  usual.update(0.003);
  fresh.update(0.003);
  EXPECT_EQ(usual.level(), fresh.level());
}

}  // namespace
}  // namespace barehand
