#include "tracking/track_state.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace barehand {
namespace {

constexpr double kFrame = 1.0 / 30;

TrackEvidence scored(double score) { return {kFrame, 5000, score, 0.0, 0.19}; }
TrackEvidence no_data() { return {kFrame, 50, std::nullopt, 0.0, 0.19}; }

std::vector<TrackPhase> play(TrackState& state, const std::vector<TrackEvidence>& script) {
  std::vector<TrackPhase> phases;
  for (const TrackEvidence& evidence : script) phases.push_back(state.update(evidence));
  return phases;
}

using S = TrackPhase;

// The tests' scores are chosen around these, whatever the defaults are.
LossParams thresholds() {
  LossParams params;
  params.lost_score = 0.004;
  params.recovered_score = 0.003;
  return params;
}

TEST(TrackState, TracksFromTheFirstGoodFrame) {
  TrackState state{thresholds()};
  EXPECT_EQ(play(state, {no_data(), scored(0.009), scored(0.0035), scored(0.002)}),
            (std::vector{S::searching, S::searching, S::searching, S::tracking}));
}

TEST(TrackState, IsLostAfterSeveralBadFramesInARow) {
  TrackState state{thresholds()};
  state.start_tracking();
  EXPECT_EQ(play(state, {scored(0.006), scored(0.006), scored(0.006), scored(0.006)}),
            (std::vector{S::tracking, S::tracking, S::tracking, S::lost}));
}

TEST(TrackState, AGoodFrameEndsTheRun) {
  TrackState state{thresholds()};
  state.start_tracking();
  for (int i = 0; i < 5; ++i) play(state, {scored(0.006), scored(0.006), scored(0.006), scored(0.002)});
  EXPECT_EQ(state.phase(), S::tracking);
}

TEST(TrackState, BetweenTheThresholdsNothingChanges) {
  TrackState state{thresholds()};
  for (int i = 0; i < 20; ++i) EXPECT_EQ(state.update(scored(0.0035)), S::searching);
  state.start_tracking();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(state.update(scored(0.0035)), S::tracking);
}

TEST(TrackState, HoldsWithoutDataThenLosesThenForgets) {
  LossParams params = thresholds();
  params.hold_time = 2.5 * kFrame;
  params.forget_time = 1.5 * kFrame;
  TrackState state(params);
  state.start_tracking();
  EXPECT_EQ(play(state, {no_data(), no_data(), no_data(), no_data(), no_data()}),
            (std::vector{S::holding, S::holding, S::lost, S::lost, S::searching}));
}

TEST(TrackState, ReturnsFromHolding) {
  TrackState state{thresholds()};
  state.start_tracking();
  EXPECT_EQ(play(state, {no_data(), scored(0.002), no_data(), scored(0.0035)}),
            (std::vector{S::holding, S::tracking, S::holding, S::tracking}));
}

TEST(TrackState, BadFramesCountAcrossHolding) {
  TrackState state{thresholds()};
  state.start_tracking();
  EXPECT_EQ(play(state, {scored(0.006), scored(0.006), no_data(), scored(0.006), scored(0.006)}),
            (std::vector{S::tracking, S::tracking, S::holding, S::holding, S::lost}));
}

TEST(TrackState, RecoversFromLossByGoodFramesOnly) {
  LossParams params = thresholds();
  params.good_frames = 2;
  TrackState state(params);
  state.start_tracking();
  play(state, {scored(0.006), scored(0.006), scored(0.006), scored(0.006)});
  EXPECT_EQ(play(state, {scored(0.0035), scored(0.002), scored(0.0035), scored(0.002), scored(0.002)}),
            (std::vector{S::lost, S::lost, S::lost, S::lost, S::tracking}));
}

TEST(TrackState, MissingAndNanScoresAreBad) {
  TrackState state{thresholds()};
  state.start_tracking();
  TrackEvidence unscored = scored(0);
  unscored.score.reset();
  const TrackEvidence nan = scored(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(play(state, {unscored, nan, unscored, nan}).back(), S::lost);
}

TrackEvidence to_be_confirmed() {
  TrackEvidence evidence = scored(0.002);
  evidence.to_be_confirmed = true;
  return evidence;
}

TEST(TrackState, ALostHandIsTentativeUntilAFrameConfirmsIt) {
  TrackState state{thresholds()};
  state.start_tracking();
  play(state, {scored(0.006), scored(0.006), scored(0.006), scored(0.006)});
  EXPECT_EQ(play(state, {to_be_confirmed(), to_be_confirmed(), scored(0.006), to_be_confirmed()}),
            (std::vector{S::tentative, S::tentative, S::lost, S::tentative}));
  EXPECT_EQ(state.status(), TrackStatus::lost) << "which is what is published of a tentative hand";
  EXPECT_EQ(state.update(scored(0.002)), S::tracking);
}

TEST(TrackState, AHandThatIsOnlyTentativeIsForgotten) {
  LossParams params = thresholds();
  params.forget_time = 2.5 * kFrame;
  TrackState state(params);
  state.start_tracking();
  play(state, {scored(0.006), scored(0.006), scored(0.006), scored(0.006)});
  EXPECT_EQ(play(state, {to_be_confirmed(), scored(0.006), to_be_confirmed()}),
            (std::vector{S::tentative, S::lost, S::searching}));
}

TEST(TrackState, ConfirmingFramesCountOnWhileTentative) {
  LossParams params = thresholds();
  params.good_frames = 2;
  TrackState state(params);
  state.start_tracking();
  play(state, {scored(0.006), scored(0.006), scored(0.006), scored(0.006), to_be_confirmed()});
  EXPECT_EQ(play(state, {scored(0.002), scored(0.002)}), (std::vector{S::lost, S::tracking}));
}

TEST(TrackState, ThresholdsGrowWithNoiseAndHand) {
  const TrackState state{thresholds()};
  TrackEvidence noisy = scored(0), large = scored(0);
  noisy.noise = 0.003;
  large.hand_length = 0.38;
  EXPECT_NEAR(state.bad_threshold(scored(0)), 0.004, 1e-12);
  EXPECT_NEAR(state.bad_threshold(noisy), 0.005, 1e-12);
  EXPECT_NEAR(state.bad_threshold(large), 0.008, 1e-12);
}

}  // namespace
}  // namespace barehand
