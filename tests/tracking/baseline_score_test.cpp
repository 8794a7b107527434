#include "tracking/baseline_score.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

TEST(BaselineScore, FallsFastAndRisesSlowly) {
  BaselineScore baseline;
  baseline.update(0.004);
  for (int i = 0; i < 15; ++i) baseline.update(0.002);
  EXPECT_NEAR(baseline.level(), 0.002, 0.0001);
  for (int i = 0; i < 15; ++i) baseline.update(0.004);
  EXPECT_LT(baseline.level(), 0.0024) << "half a second of worse frames must still stand out";
  for (int i = 0; i < 600; ++i) baseline.update(0.004);
  EXPECT_NEAR(baseline.level(), 0.004, 0.0001) << "but what stays so is baseline";
}

TEST(BaselineScore, AFirstScoreIsNotYetUsual) {
  BaselineScore baseline;
  for (int i = 0; i < 10; ++i) baseline.update(0.004);
  EXPECT_LT(baseline.level(), 0.004 / 1.2) << "the hand may have been found in a wrong pose";
  for (int i = 0; i < 100; ++i) baseline.update(0.004);
  EXPECT_GT(baseline.level(), 0.004 / 1.15) << "but a hand that no search improves is not searched for ever";
}

TEST(BaselineScore, StartsAnewAfterAReset) {
  BaselineScore baseline, fresh;
  baseline.update(0.001);
  baseline.reset();
  baseline.update(0.003);
  fresh.update(0.003);
  EXPECT_EQ(baseline.level(), fresh.level());
}

}  // namespace
}  // namespace barehand
