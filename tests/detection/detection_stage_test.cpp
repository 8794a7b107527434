#include "stages/detection/detection_stage.h"

#include "stages/detection/depth_view.h"
#include "stages/detection/probable_hands.h"
#include "support/rendered_person.h"

namespace barehand {
namespace {

/// When the stage looks, and where.
class DetectionStageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    test::RenderedPerson person(test::vga_camera());
    pose_ = test::facing_pose(*profile_, 0.6);
    person.hand(*profile_, pose_, pose_[kPalm].t + Eigen::Vector3d(0.05, 0.14, 0.17));
    frame_ = person.frame();
  }
  DetectionStage stage(DetectionParams params = {}) {
    params.enabled = true;
    return DetectionStage(params, std::string(BAREHAND_CONFIGS) + "/nets", workers_, make_silent_logger());
  }
  HandEstimatePtr earlier(TrackStatus status) const {
    auto estimate = std::make_shared<HandEstimate>();
    estimate->status = status;
    estimate->profile = profile_;
    for (int s = 0; s < kSegmentCount; ++s) estimate->segments[s].T_camera_segment = pose_[s];
    return estimate;
  }
  void paint(Rgb colour) { frame_->colour.reset(640, 480, colour); }

  Workers workers_{1};
  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  HandPose pose_;
  std::shared_ptr<RgbdFrame> frame_;
};

TEST_F(DetectionStageTest, SwitchedOffItFindsNothing) {
  DetectionStage off({.enabled = false}, std::string(BAREHAND_CONFIGS) + "/nets", workers_, make_silent_logger());
  EXPECT_EQ(off.process(frame_, {}), nullptr);
}

TEST_F(DetectionStageTest, LooksAtTheWholeFrameWhileAHandIsSearchedFor) {
  DetectionStage searching = stage();
  for (const TrackStatus status : {TrackStatus::searching, TrackStatus::holding, TrackStatus::lost}) {
    const std::vector<HandEstimatePtr> feedback = {earlier(status)};
    const DetectionPtr detection = searching.process(frame_, feedback);
    ASSERT_TRUE(detection);
    EXPECT_TRUE(detection->whole_frame);
    EXPECT_EQ(detection->hands.size(), 1u);
  }
}

TEST_F(DetectionStageTest, LooksAroundATrackedHandOnlyWhereColourIsMissingOrNotEnough) {
  DetectionStage tracking = stage();
  const std::vector<HandEstimatePtr> feedback = {earlier(TrackStatus::tracking)};
  const DetectionPtr without_colour = tracking.process(frame_, feedback);
  ASSERT_TRUE(without_colour);
  EXPECT_FALSE(without_colour->whole_frame);
  EXPECT_EQ(without_colour->hands.size(), 1u);
  paint({200, 150, 120});
  EXPECT_EQ(tracking.process(frame_, feedback), nullptr);
  EXPECT_TRUE(tracking.process(frame_, feedback, true));
  paint({120, 120, 120});
  EXPECT_TRUE(tracking.process(frame_, feedback));
}

TEST_F(DetectionStageTest, LooksForTheOtherHandNowAndThen) {
  paint({200, 150, 120});
  DetectionStage both = stage();
  const std::vector<HandEstimatePtr> feedback = {earlier(TrackStatus::tracking), earlier(TrackStatus::searching)};
  int looked = 0;
  for (int i = 0; i < 9; ++i) looked += both.process(frame_, feedback)->hands.size() == 1;
  EXPECT_EQ(looked, 3);
}

/// A hand of each side, clearly so.
std::vector<DetectedHand> right_and_left() {
  std::vector<DetectedHand> hands(2);
  hands[0].right_log_odds = 5;
  hands[0].hand_log_odds = 4;
  hands[1].right_log_odds = -5;
  hands[1].hand_log_odds = 3;
  return hands;
}

TEST(SortByProbability, TheWantedSideComesFirstThenTheOtherOne) {
  std::vector<DetectedHand> hands = right_and_left();
  sort_by_probability(hands, Handedness::left);
  EXPECT_LT(hands[0].right_log_odds, 0);
  sort_by_probability(hands, Handedness::right);
  EXPECT_GT(hands[0].right_log_odds, 0);
}

TEST(SortByProbability, WithBothHandsWantedTheSurerOneComesFirst) {
  std::vector<DetectedHand> hands = right_and_left();
  std::swap(hands[0], hands[1]);
  sort_by_probability(hands, std::nullopt);
  EXPECT_EQ(hands[0].hand_log_odds, 4);
}

TEST_F(DetectionStageTest, BetweenTwoDetectionsNothingIsAHand) {
  DetectionParams params;
  params.every = 2;
  DetectionStage searching = stage(params);
  EXPECT_EQ(searching.process(frame_, {})->hands.size(), 1u);
  const DetectionPtr between = searching.process(frame_, {});
  ASSERT_TRUE(between);
  EXPECT_TRUE(between->whole_frame);
  EXPECT_TRUE(between->hands.empty());
}

TEST_F(DetectionStageTest, EveryOtherSearchOfAFrameWithColourSeesSkinOnly) {
  const SkinModel skin(0.08, 0.85);
  DetectionStage searching = stage();
  const auto next = [&] { return searching.process(frame_, {}, false, &skin)->hands; };

  // A blue hand is seen by its depth alone.
  paint({40, 60, 160});
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(next().size(), 1u);
    EXPECT_TRUE(next().empty());
  }

  // A hand with the colour of skin is seen in every search.
  for (std::size_t i = 0; i < frame_->colour.size(); ++i)
    if (frame_->depth[i] < 700) frame_->colour[i] = {200, 150, 120};
  for (const bool skin_only : {false, true, false, true}) {
    const auto hands = next();
    ASSERT_EQ(hands.size(), 1u);
    EXPECT_EQ(hands[0].skin_only, skin_only);
    EXPECT_LT((hands[0].centre - pose_[kPalm].t).norm(), 0.08);
  }

  // Grey shows no skin.
  paint({120, 120, 120});
  for (int i = 0; i < 2; ++i) EXPECT_EQ(next().size(), 1u);
}

TEST(KeepSkin, WhatIsNotSkinIsFarAway) {
  RgbdFrame frame;
  frame.camera = {64, 48, 50, 50, 31.5, 23.5};
  frame.depth.reset(64, 48, 600);
  frame.depth.at(3, 3) = frame.depth.at(60, 40) = 0;
  frame.colour.reset(64, 48, {40, 60, 160});
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 32; ++u) frame.colour.at(u, v) = {200, 150, 120};
  const DepthView view(64, 48, 50, 31.5, 23.5, frame.camera);
  Image<float> depth;
  sample_depth(frame, view, depth);
  keep_skin(frame, view, SkinModel(0, 0), depth);
  EXPECT_FLOAT_EQ(depth.at(10, 20), 0.6f);
  EXPECT_GT(depth.at(50, 20), 2);
  EXPECT_EQ(depth.at(3, 3), 0);  // what was not measured stays so
  EXPECT_EQ(depth.at(60, 40), 0);
}

TEST_F(DetectionStageTest, AFrameWithoutIntrinsicsIsLeftToPreprocessing) {
  DetectionStage searching = stage();
  frame_->camera = {};
  EXPECT_EQ(searching.process(frame_, {}), nullptr);
}

}  // namespace
}  // namespace barehand
