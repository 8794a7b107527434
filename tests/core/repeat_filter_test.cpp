#include "core/repeat_filter.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

TEST(RepeatFilter, OnePerIntervalAndCountsTheRest) {
  ManualClock clock(1000);
  RepeatFilter filter(clock, 100);
  EXPECT_EQ(filter.admit("a"), 0);
  EXPECT_EQ(filter.admit("a"), std::nullopt);
  clock.advance(99);
  EXPECT_EQ(filter.admit("a"), std::nullopt);
  clock.advance(1);
  EXPECT_EQ(filter.admit("a"), 2);
  clock.advance(100);
  EXPECT_EQ(filter.admit("a"), 0);
}

TEST(RepeatFilter, KindsAreIndependent) {
  ManualClock clock;
  RepeatFilter filter(clock, 100);
  EXPECT_EQ(filter.admit("a"), 0);
  EXPECT_EQ(filter.admit("b"), 0);
}

}  // namespace
}  // namespace barehand
