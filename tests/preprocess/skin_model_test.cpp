#include "observe/skin_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace barehand {
namespace {

TEST(SkinModel, KnowsSkinOfAllTonesBeforeLearning) {
  const SkinModel model(0.1, 0.85);
  for (const Rgb skin : {Rgb{236, 200, 185}, Rgb{205, 150, 120}, Rgb{141, 96, 70}, Rgb{90, 58, 42}, Rgb{131, 76, 79}})
    EXPECT_GT(model.log_odds(skin), 0.4f) << +skin.r;
  for (const Rgb other : {Rgb{60, 160, 70}, Rgb{40, 60, 140}, Rgb{128, 128, 128}, Rgb{190, 200, 40}, Rgb{200, 30, 30}})
    EXPECT_LT(model.log_odds(other), -0.4f) << +other.r;
}

TEST(SkinModel, BlackDarkAndOverexposedPixelsSayLittle) {
  const SkinModel model(0.1, 0.85);
  EXPECT_EQ(model.log_odds(Rgb{}), 0.f);
  EXPECT_EQ(model.log_odds(Rgb{255, 252, 251}), 0.f);
  EXPECT_LT(std::abs(model.log_odds(Rgb{12, 7, 6})), 0.3f);
}

TEST(SkinModel, LearnsToTellAWoodenObjectFromThisSkin) {
  SkinModel model(0.1, 0.85);
  const Rgb skin{205, 150, 128}, wood{170, 126, 88};
  ASSERT_GT(model.log_odds(wood), 0.4f);
  for (int frame = 0; frame < 20; ++frame) model.learn(std::vector<Rgb>(200, skin), std::vector<Rgb>(200, wood));
  EXPECT_LT(model.log_odds(wood), -0.4f);
  EXPECT_GT(model.log_odds(skin), 0.4f);
}

TEST(SkinModel, WhatIsMuchDarkerThanThisSkinIsSomethingElse) {
  SkinModel model(0.1, 0.85);
  const auto shade = [](double share) {
    const auto channel = [share](double full) { return static_cast<std::uint8_t>(std::lround(share * full)); };
    return Rgb{channel(205), channel(150), channel(128)};
  };
  ASSERT_GT(model.log_odds(shade(0.2)), 0.4f);  // before this person's skin is learned, it may be dark
  std::vector<Rgb> skin;
  for (int i = 0; i < 200; ++i) skin.push_back(shade(0.7 + 0.3 * i / 200));
  for (int frame = 0; frame < 20; ++frame) model.learn(skin, {});
  EXPECT_LT(model.log_odds(shade(0.2)), -0.4f);
  EXPECT_GT(model.log_odds(shade(0.5)), 0.4f);  // this person's skin in the shadow of an object
  EXPECT_EQ(model.log_odds(Rgb{}), 0.f);        // no colour
}

TEST(SkinModel, FollowsTheLightHoweverLongItHasLearned) {
  SkinModel model(0.1, 0.85);
  const Rgb day{205, 150, 128}, dusk{41, 30, 26};
  for (int frame = 0; frame < 2000; ++frame) model.learn(std::vector<Rgb>(200, day), {});
  ASSERT_LT(model.log_odds(dusk), -0.4f);
  for (int frame = 0; frame < 60; ++frame) model.learn(std::vector<Rgb>(200, dusk), {});
  EXPECT_GT(model.log_odds(dusk), 0.4f);
}

TEST(SkinModel, SkinSeenAlsoElsewhereStaysUndecidedRatherThanLost) {
  SkinModel model(0.1, 0.85);
  const Rgb skin{205, 150, 128};
  for (int frame = 0; frame < 50; ++frame) model.learn(std::vector<Rgb>(200, skin), std::vector<Rgb>(200, skin));
  EXPECT_GT(model.log_odds(skin), -0.4f);
}

TEST(SkinModel, AHandfulOfPixelsTeachesNothing) {
  SkinModel model(0.5, 0.85);
  const Rgb green{60, 160, 70};
  const float before = model.log_odds(green);
  model.learn(std::vector<Rgb>(5, green), {});
  EXPECT_EQ(model.log_odds(green), before);
}

}  // namespace
}  // namespace barehand
