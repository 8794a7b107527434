#include "tracking/loss_detector.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace barehand {
namespace {

constexpr double kFrame = 1.0 / 30;

TrackEvidence scored(double score) { return {kFrame, 5000, score, 0.0, 0.19}; }
TrackEvidence no_data() { return {kFrame, 50, std::nullopt, 0.0, 0.19}; }

std::vector<TrackStatus> play(LossDetector& detector, const std::vector<TrackEvidence>& script) {
  std::vector<TrackStatus> states;
  for (const TrackEvidence& evidence : script) states.push_back(detector.update(evidence));
  return states;
}

using S = TrackStatus;

// The tests' scores are chosen around these, whatever the defaults are.
LossParams thresholds() {
  LossParams params;
  params.lost_score = 0.004;
  params.recovered_score = 0.003;
  return params;
}

TEST(LossDetector, TracksFromTheFirstGoodFrame) {
  LossDetector detector{thresholds()};
  EXPECT_EQ(play(detector, {no_data(), scored(0.009), scored(0.0035), scored(0.002)}),
            (std::vector{S::searching, S::searching, S::searching, S::tracking}));
}

TEST(LossDetector, IsLostAfterSeveralBadFramesInARow) {
  LossDetector detector{thresholds()};
  detector.start_tracking();
  EXPECT_EQ(play(detector, {scored(0.006), scored(0.006), scored(0.006), scored(0.006)}),
            (std::vector{S::tracking, S::tracking, S::tracking, S::lost}));
}

TEST(LossDetector, AGoodFrameEndsTheRun) {
  LossDetector detector{thresholds()};
  detector.start_tracking();
  for (int i = 0; i < 5; ++i) play(detector, {scored(0.006), scored(0.006), scored(0.006), scored(0.002)});
  EXPECT_EQ(detector.status(), S::tracking);
}

TEST(LossDetector, BetweenTheThresholdsNothingChanges) {
  LossDetector detector{thresholds()};
  for (int i = 0; i < 20; ++i) EXPECT_EQ(detector.update(scored(0.0035)), S::searching);
  detector.start_tracking();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(detector.update(scored(0.0035)), S::tracking);
}

TEST(LossDetector, HoldsWithoutDataThenLosesThenForgets) {
  LossParams params = thresholds();
  params.hold_time = 2.5 * kFrame;
  params.forget_time = 1.5 * kFrame;
  LossDetector detector(params);
  detector.start_tracking();
  EXPECT_EQ(play(detector, {no_data(), no_data(), no_data(), no_data(), no_data()}),
            (std::vector{S::holding, S::holding, S::lost, S::lost, S::searching}));
}

TEST(LossDetector, ReturnsFromHolding) {
  LossDetector detector{thresholds()};
  detector.start_tracking();
  EXPECT_EQ(play(detector, {no_data(), scored(0.002), no_data(), scored(0.0035)}),
            (std::vector{S::holding, S::tracking, S::holding, S::tracking}));
}

TEST(LossDetector, BadFramesCountAcrossHolding) {
  LossDetector detector{thresholds()};
  detector.start_tracking();
  EXPECT_EQ(play(detector, {scored(0.006), scored(0.006), no_data(), scored(0.006), scored(0.006)}),
            (std::vector{S::tracking, S::tracking, S::holding, S::holding, S::lost}));
}

TEST(LossDetector, RecoversFromLossByGoodFramesOnly) {
  LossParams params = thresholds();
  params.good_frames = 2;
  LossDetector detector(params);
  detector.start_tracking();
  play(detector, {scored(0.006), scored(0.006), scored(0.006), scored(0.006)});
  EXPECT_EQ(play(detector, {scored(0.0035), scored(0.002), scored(0.0035), scored(0.002), scored(0.002)}),
            (std::vector{S::lost, S::lost, S::lost, S::lost, S::tracking}));
}

TEST(LossDetector, MissingAndNanScoresAreBad) {
  LossDetector detector{thresholds()};
  detector.start_tracking();
  TrackEvidence unscored = scored(0);
  unscored.score.reset();
  const TrackEvidence nan = scored(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(play(detector, {unscored, nan, unscored, nan}).back(), S::lost);
}

TEST(LossDetector, ThresholdsGrowWithNoiseAndHand) {
  const LossDetector detector{thresholds()};
  TrackEvidence noisy = scored(0), large = scored(0);
  noisy.noise = 0.003;
  large.hand_length = 0.38;
  EXPECT_NEAR(detector.bad_threshold(scored(0)), 0.004, 1e-12);
  EXPECT_NEAR(detector.bad_threshold(noisy), 0.005, 1e-12);
  EXPECT_NEAR(detector.bad_threshold(large), 0.008, 1e-12);
}

}  // namespace
}  // namespace barehand
