#include "evaluation/reliability.h"

#include <gtest/gtest.h>

#include "math/random.h"

namespace barehand {
namespace {

constexpr double kDeviation = 0.003;  // m, standard deviation of the error along each axis

/// A true sequence, and estimates of it. Their errors have the standard deviation kDeviation, but their covariances
/// state `stated` [m].
std::pair<ResultTable, StatedPoses> sequence(double stated, std::uint32_t key, double confidence = 0.5) {
  KeyedRandom random(7, key);
  const auto off = [&]() -> Eigen::Vector3d {
    return Eigen::Vector3d(random.normal(), random.normal(), random.normal()) * kDeviation;
  };
  std::pair<ResultTable, StatedPoses> out;
  for (int i = 0; i < 200; ++i) {
    TableFrame frame{i, 0.1 * i, {}};
    out.second[i].utime = 100'000 * i;
    for (int s = 0; s < kSegmentCount; ++s) {
      frame.rows[s] = {{0.01 * s, 0, 0.5}, {0.01 * s, 0.03, 0.5}, 1};

      // Both ends are off by random errors.
      const Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity() * stated * stated;
      out.second[i].segments[s] = {
          frame.rows[s].proximal + off(), frame.rows[s].distal + off(), covariance, covariance, confidence, s < 8};
    }
    out.first.frames.push_back(frame);
  }
  return out;
}

TEST(Reliability, RightStatementsCoverNineOfTen) {
  const auto r = evaluate_reliability({sequence(kDeviation, 1)});
  ASSERT_TRUE(r);
  EXPECT_EQ(r->frames, 200u);
  EXPECT_EQ(r->all.intervals, 200u * kSegmentCount * 2 * 3);
  EXPECT_NEAR(r->all.covered, 0.9, 0.01);
  EXPECT_NEAR(r->seen.covered, 0.9, 0.01);
  EXPECT_EQ(r->seen.intervals, r->inferred.intervals);
  EXPECT_NEAR(r->all.stated, std::sqrt(3) * kDeviation, 1e-9);
  EXPECT_NEAR(r->all.actual, std::sqrt(3) * kDeviation, 1e-4);
}

TEST(Reliability, BoldAndTimidStatementsAreFoundOut) {
  EXPECT_LT(evaluate_reliability({sequence(kDeviation / 2, 1)})->all.covered, 0.62);
  EXPECT_GT(evaluate_reliability({sequence(kDeviation * 2, 1)})->all.covered, 0.99);
}

TEST(Reliability, BinsHoldWhatWasSaidAgainstWhatWas) {
  const auto r = evaluate_reliability({sequence(kDeviation, 1, 0.95), sequence(4 * kDeviation, 2, 0.31)});
  ASSERT_TRUE(r);
  ASSERT_EQ(r->errors.size(), 2u);
  EXPECT_NEAR(r->errors[0].stated, r->errors[0].actual, 1e-4);
  EXPECT_NEAR(r->errors[1].stated, 4 * r->errors[1].actual, 4e-4);
  ASSERT_EQ(r->confidences.size(), 2u);
  EXPECT_NEAR(r->confidences[0].stated, 0.31, 1e-9);
  EXPECT_NEAR(r->confidences[1].stated, 0.95, 1e-9);
  // The error of each of the two ends has three independent axes and must be within 10 mm: (chi-square of 3 degrees of
  // freedom up to (10 / 3)^2) squared.
  EXPECT_NEAR(r->confidences[1].actual, 0.9887 * 0.9887, 0.01);
}

TEST(Reliability, WithoutACommonFrameThereIsNothingToSay) {
  auto other = sequence(kDeviation, 1);
  for (TableFrame& frame : other.first.frames) frame.number += 1000;
  EXPECT_FALSE(evaluate_reliability({other}));
}

TEST(Reliability, StatesOfAnotherRecordingAreRefused) {
  auto other = sequence(kDeviation, 1);
  other.second[3].utime += 5000;
  EXPECT_FALSE(evaluate_reliability({other}));
}

}  // namespace
}  // namespace barehand
