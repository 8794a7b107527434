#include "core/repeat_filter.h"

#include <gtest/gtest.h>

#include <vector>

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

TEST(RepeatFilter, IntervalsGrowUntilAReset) {
  constexpr int kGrowth = 4;
  ManualClock clock;
  RepeatFilter filter(clock, 3, kGrowth);
  std::vector<std::int64_t> passed;
  for (; clock.steady_us() < 100; clock.advance(1))
    if (filter.admit("a")) passed.push_back(clock.steady_us());
  EXPECT_EQ(passed, (std::vector<std::int64_t>{0, 3, 15, 63}));
  filter.reset();
  EXPECT_EQ(filter.admit("a"), 0);
  clock.advance(3);
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
