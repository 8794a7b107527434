#include "core/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace barehand {
namespace {

TEST(TimeHistogram, EmptyIsNotANumber) {
  const TimeSummary s = TimeHistogram().summary();
  EXPECT_EQ(s.count, 0);
  EXPECT_TRUE(std::isnan(s.mean));
  EXPECT_TRUE(std::isnan(s.p95));
}

TEST(TimeHistogram, PercentilesOfUniformDurations) {
  TimeHistogram histogram;
  for (int us = 1; us <= 100000; ++us) histogram.add(us);
  const TimeSummary s = histogram.summary();
  EXPECT_EQ(s.count, 100000);
  EXPECT_DOUBLE_EQ(s.mean, 0.0500005);
  EXPECT_DOUBLE_EQ(s.max, 0.1);
  EXPECT_NEAR(s.p50, 0.050, 0.05 * 0.050);
  EXPECT_NEAR(s.p95, 0.095, 0.05 * 0.095);
  EXPECT_NEAR(s.p99, 0.099, 0.05 * 0.099);
}

TEST(TimeHistogram, EveryScaleIsWithinFivePercent) {
  for (std::int64_t us = 1; us < (std::int64_t{1} << 36); us = us * 7 / 5 + 1) {
    TimeHistogram histogram;
    histogram.add(us);
    histogram.add(us * 100);  // keeps the maximum from clipping the bucket
    EXPECT_NEAR(histogram.summary().p50, us * 1e-6, 0.05 * us * 1e-6) << us;
  }
}

TEST(TimeHistogram, OutlierMovesMaximumNotMedian) {
  TimeHistogram histogram;
  for (int i = 0; i < 99; ++i) histogram.add(10);
  histogram.add(5'000'000);
  EXPECT_NEAR(histogram.summary().p50, 10e-6, 1e-9);
  EXPECT_DOUBLE_EQ(histogram.summary().max, 5.0);
}

TEST(TimeHistogram, ClockSetBackAndHugeDurationsStayInRange) {
  TimeHistogram histogram;
  histogram.add(-5);
  histogram.add(std::int64_t{1} << 50);
  EXPECT_EQ(histogram.summary().count, 2);
  EXPECT_DOUBLE_EQ(histogram.summary().p50, 0.0);
}

}  // namespace
}  // namespace barehand
