#include "stages/detection/palm_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

namespace barehand {
namespace {

/// A palm that is seen in one frame after the other, and what is found at its place.
class PalmHistoryTest : public ::testing::Test {
 protected:
  /// A frame with one palm. Returns whether its place was examined; then a hand was found whose log odds of being one
  /// are these.
  bool frame(const std::optional<double>& hand_log_odds, double probability = 0.6,
             const Eigen::Vector3d& palm = {0, 0, 0.7}) {
    places_.begin_search();
    if (places_.may_skip(palm, probability)) return false;
    DetectedHand hand;
    hand.centre = palm;
    hand.hand_log_odds = hand_log_odds.value_or(0);
    places_.examined(palm, probability, hand_log_odds ? &hand : nullptr);
    return true;
  }
  std::string frames(int n, const std::optional<double>& hand_log_odds) {
    std::string examined;
    for (int i = 0; i < n; ++i) examined += frame(hand_log_odds) ? '1' : '0';
    return examined;
  }

  PalmHistory places_;
};

TEST_F(PalmHistoryTest, WhatIsAHandIsExaminedInEveryFrame) { EXPECT_EQ(frames(10, 4), "1111111111"); }

TEST_F(PalmHistoryTest, WhatIsNoHandForLongIsExaminedInEverySecondFrame) {
  EXPECT_EQ(frames(11, std::nullopt), "11111101010");
  places_ = {};
  EXPECT_EQ(frames(11, -0.5), "11111101010");
}

TEST_F(PalmHistoryTest, WhatStaysUnlikelyIsExaminedEverMoreRarely) {
  frames(18, std::nullopt);
  EXPECT_EQ(frames(9, std::nullopt), "001001001");
  frames(200, std::nullopt);
  const std::string later = frames(20, std::nullopt);
  EXPECT_EQ(std::ranges::count(later, '1'), 4) << later;
}

TEST_F(PalmHistoryTest, WhatIsReadAsBothSidesWaitsTwiceAsSoon) {
  DetectedHand hand;
  hand.hand_log_odds = -0.5;
  hand.other_joints = hand.joints;
  std::string examined;
  for (int i = 0; i < 7; ++i) {
    places_.begin_search();
    const bool skipped = places_.may_skip({0, 0, 0.7}, 0.6);
    if (!skipped) places_.examined({0, 0, 0.7}, 0.6, &hand);
    examined += skipped ? '0' : '1';
  }
  EXPECT_EQ(examined, "1110101");
}

TEST_F(PalmHistoryTest, AHandEndsTheWaiting) {
  EXPECT_EQ(frames(7, -0.5), "1111110");
  EXPECT_EQ(frames(4, 4), "1111");
}

TEST_F(PalmHistoryTest, APalmThatChangesOrMovesDoesNotWait) {
  frames(6, -0.5);
  EXPECT_TRUE(frame(-0.5, 0.75));
  EXPECT_FALSE(frame(-0.5, 0.75));
  EXPECT_TRUE(frame(-0.5, 0.75));
  EXPECT_TRUE(frame(-0.5, 0.75, {0.06, 0, 0.7}));
}

TEST_F(PalmHistoryTest, ThePlaceThatAPalmLeftIsForgotten) {
  frames(6, -0.5);
  for (int i = 0; i < 6; ++i) places_.begin_search();
  EXPECT_EQ(frames(7, -0.5), "1111110");
}

}  // namespace
}  // namespace barehand
