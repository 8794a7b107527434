#include "stages/preprocess/standing_depth.h"

#include <gtest/gtest.h>

#include <optional>

#include "stages/preprocess/preprocess.h"
#include "tests/preprocess/painted_scene.h"

namespace barehand {
namespace {

using test::label_at;
using test::painted_hand_estimate;
using test::PaintedScene;

constexpr double kX = -0.06, kY = 0.06, kZ = 0.5;  // the wrist where the hand does not touch the block [m]
constexpr double kTouch = 0.02;                    // x of the wrist where the thumb touches the block [m]
constexpr double kBlock = kTouch + 0.085;          // left side of the block [m]
constexpr double kInBlock = kBlock + 0.02, kInThumb = kTouch + 0.07, kMiddle = kY - 0.045;  // points on block and thumb
constexpr int kLong = 30, kShort = 5;  // frames of 1/30 s: long enough to stand, and too short for that

/// A wall and a block before it that is coloured like skin.
PaintedScene block(double z = kZ) { return PaintedScene().patch(kBlock, kY - 0.08, kBlock + 0.04, kY, z, test::kSkin); }

/// Preprocesses frames of a scene in which a hand has its wrist at (x, kY, z).
class StandingDepthTest : public ::testing::Test {
 protected:
  /// `status`: that of the hand in the feedback; none: there is no feedback.
  HandObservationPtr see(PaintedScene scene, double x, double z = kZ, int frames = 1,
                         std::optional<TrackStatus> status = TrackStatus::tracking,
                         const DetectionPtr& detection = nullptr) {
    scene.hand(x, kY, z);
    HandObservationPtr last;
    for (int i = 0; i < frames; ++i, ++number_) {
      HandEstimates feedback;
      if (status) {
        HandEstimate earlier = painted_hand_estimate(x, kY, z, number_ - 1);
        earlier.status = *status;
        feedback.push_back(std::make_shared<HandEstimate>(std::move(earlier)));
      }
      const Result<HandObservations> seen = preprocessor_.process(scene.share(number_), feedback, detection);
      EXPECT_TRUE(seen.has_value());
      last = seen->front();
    }
    return last;
  }

 private:
  Preprocessor preprocessor_{PreprocessParams{}};
  std::int64_t number_ = 1;
};

TEST_F(StandingDepthTest, WhatStoodThereBeforeIsNoHand) {
  see(block(), kX, kZ, kLong);
  const auto o = see(block(), kTouch);
  EXPECT_NE(label_at(*o, kInBlock, kMiddle, kZ), PixelLabel::hand);
  EXPECT_EQ(label_at(*o, kInThumb, kMiddle, kZ), PixelLabel::hand);
}

TEST_F(StandingDepthTest, WhatCameWithTheHandIsNotToldApart) {
  see(block(), kX, kZ, kShort);
  const auto o = see(block(), kTouch);
  EXPECT_EQ(label_at(*o, kInBlock, kMiddle, kZ), PixelLabel::hand);
}

TEST_F(StandingDepthTest, IsRememberedWhileTheHandIsInFrontOfIt) {
  see(block(), kX, kZ, kLong);
  see(block(), kBlock, kZ - 0.04, kLong);
  const auto o = see(block(), kTouch);
  EXPECT_NE(label_at(*o, kInBlock, kMiddle, kZ), PixelLabel::hand);
}

TEST_F(StandingDepthTest, WhatWasTakenAwayIsForgotten) {
  see(block(), kX, kZ, kLong);
  see(PaintedScene(), kX, kZ, kLong);
  const auto o = see(PaintedScene(), kInBlock - 0.07);  // the thumb is where the block stood
  EXPECT_EQ(label_at(*o, kInBlock, kMiddle, kZ), PixelLabel::hand);
}

TEST_F(StandingDepthTest, AHandThatRestedBeforeItWasTrackedIsAHand) {
  see(block(), kX, kZ, kLong, std::nullopt);
  const auto o = see(block(), kX);
  EXPECT_EQ(label_at(*o, kX, kY - 0.04, kZ), PixelLabel::hand);
  EXPECT_EQ(label_at(*o, kX + 0.0315, kY - 0.16, kZ), PixelLabel::hand);
}

TEST_F(StandingDepthTest, AHandThatRestedUnseenAndIsFollowedAgainIsAHand) {
  const auto nothing = std::make_shared<Detection>();
  nothing->whole_frame = true;
  EXPECT_FALSE(see(block(), kX, kZ, kLong, std::nullopt, nothing)->hand_present);
  EXPECT_TRUE(see(block(), kX, kZ, 1, TrackStatus::holding)->followed);
  const auto o = see(block(), kX);
  EXPECT_TRUE(o->followed);
  EXPECT_EQ(label_at(*o, kX, kY - 0.04, kZ), PixelLabel::hand);
}

TEST_F(StandingDepthTest, AMovedSensorForgetsEverything) {
  see(block(), kX, kZ, kLong);
  see(block(kZ + 0.03), kX);
  const auto o = see(block(), kTouch);
  EXPECT_EQ(label_at(*o, kInBlock, kMiddle, kZ), PixelLabel::hand);
}

}  // namespace
}  // namespace barehand
