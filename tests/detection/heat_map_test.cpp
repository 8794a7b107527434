#include "stages/detection/heat_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace barehand {
namespace {

TEST(FindPeaks, GivesEveryHighestCellOnceMostProbableFirst) {
  std::vector<float> logits(8 * 5, -5.f);
  logits[1 * 8 + 2] = 1.f;
  logits[1 * 8 + 3] = 0.5f;  // next to the maximum
  logits[3 * 8 + 7] = 2.f;   // at the border
  logits[4 * 8 + 0] = -3.f;  // improbable
  const auto peaks = find_peaks({logits.data(), 8, 5}, 0.2);
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_EQ(peaks[0].column, 7);
  EXPECT_EQ(peaks[0].row, 3);
  EXPECT_NEAR(peaks[0].probability, 1 / (1 + std::exp(-2.)), 1e-12);
  EXPECT_EQ(peaks[1].column, 2);
}

TEST(FindPeaks, OfAPlateauOnlyOneCellIsAPeak) {
  std::vector<float> logits(6 * 6, -5.f);
  for (const int i : {14, 15, 20, 21}) logits[i] = 1.f;
  EXPECT_EQ(find_peaks({logits.data(), 6, 6}, 0.2).size(), 1u);
}

TEST(HeatMoments, OfAGaussianAreItsOwn) {
  std::vector<float> logits(24 * 24), depth(24 * 24);
  for (int r = 0; r < 24; ++r)
    for (int c = 0; c < 24; ++c) {
      logits[r * 24 + c] = static_cast<float>(50 - (c - 10.5) * (c - 10.5) / (2 * 4) - (r - 8.25) * (r - 8.25) / 2);
      depth[r * 24 + c] = static_cast<float>(0.1 * c);
    }
  const HeatMoments moments = heat_moments({logits.data(), 24, 24}, depth.data());
  EXPECT_NEAR(moments.mean.x(), 10.5, 1e-3);
  EXPECT_NEAR(moments.mean.y(), 8.25, 1e-3);
  EXPECT_NEAR(moments.covariance(0, 0), 4, 0.02);
  EXPECT_NEAR(moments.covariance(1, 1), 1, 0.01);
  EXPECT_NEAR(moments.covariance(0, 1), 0, 1e-3);
  EXPECT_NEAR(moments.value_mean, 1.05, 1e-3);
  EXPECT_NEAR(moments.value_variance, 0.04, 1e-3);
}

}  // namespace
}  // namespace barehand
