#include "stages/preprocess/preprocess.h"

#include <gtest/gtest.h>

#include "tests/preprocess/painted_scene.h"

namespace barehand {
namespace {

using test::label_at;
using test::painted_hand_estimate;
using test::PaintedScene;
constexpr double kX = 0.0, kY = 0.06, kZ = 0.5;  // wrist

HandObservationPtr observe(const PaintedScene& scene, const HandEstimate* hint = nullptr) {
  Preprocessor preprocessor{PreprocessParams{}};
  const Result<HandObservationPtr> result = preprocessor.process(scene.share(), hint);
  EXPECT_TRUE(result.has_value());
  return *result;
}

TEST(Preprocess, SkinBeforeAWallIsHand) {
  const auto o = observe(PaintedScene().hand(kX, kY, kZ));
  ASSERT_TRUE(o->hand_present);
  EXPECT_EQ(label_at(*o, kX, kY - 0.04, kZ), PixelLabel::hand);           // palm
  EXPECT_EQ(label_at(*o, kX + 0.0315, kY - 0.16, kZ), PixelLabel::hand);  // index
  EXPECT_EQ(label_at(*o, kX + 0.07, kY - 0.045, kZ), PixelLabel::hand);   // thumb
  EXPECT_EQ(label_at(*o, kX + 0.07, kY - 0.15, kZ), PixelLabel::background);
  EXPECT_NEAR(o->hand_pixels.size(), (0.08 * 0.09 + 4 * 0.016 * 0.09 + 0.045 * 0.02) * 480 * 480, 250);
}

TEST(Preprocess, GreenBallInFrontIsObject) {
  const auto o = observe(PaintedScene().hand(kX, kY, kZ).patch(-0.03, -0.03, 0.02, 0.02, 0.45, test::kGreen));
  EXPECT_EQ(label_at(*o, 0, 0, 0.45), PixelLabel::object);
  EXPECT_EQ(label_at(*o, 0, kY - 0.015, kZ), PixelLabel::hand);
}

TEST(Preprocess, ObjectTouchingTheHandAtItsDepthIsToldApartByColour) {
  const auto o = observe(PaintedScene().hand(kX, kY, kZ).patch(-0.02, -0.01, 0.02, 0.03, kZ, test::kGreen));
  EXPECT_EQ(label_at(*o, 0, 0.01, kZ), PixelLabel::object);
  EXPECT_EQ(label_at(*o, 0.03, 0.01, kZ), PixelLabel::hand);
}

TEST(Preprocess, MissingDepthStaysUnknown) {
  const auto o = observe(PaintedScene().hand(kX, kY, kZ).erase_depth(150, 115, 160, 125));
  const int u = 155 - o->u0, v = 120 - o->v0;
  EXPECT_EQ(o->label.at(u, v), PixelLabel::unknown);
  EXPECT_EQ(o->depth.at(u, v), 0.f);
  EXPECT_GE(o->nearest_hand.at(u, v), 0);
}

TEST(Preprocess, WithoutColourTheNearSurfaceIsHandAndTheForearmIsCut) {
  const auto o = observe(PaintedScene().hand(kX, kY, kZ).forearm(kX, kY, kZ, test::kSkin).no_colour());
  EXPECT_EQ(label_at(*o, kX, kY - 0.04, kZ), PixelLabel::hand);
  EXPECT_EQ(label_at(*o, kX, kY - 0.15, kZ + 0.7), PixelLabel::background);
  EXPECT_EQ(label_at(*o, kX + 0.0105, kY - 0.17, kZ), PixelLabel::hand);
  EXPECT_EQ(label_at(*o, kX, kY + 0.04, kZ), PixelLabel::object);
}

TEST(Preprocess, BareForearmIsCutAtTheHintedWrist) {
  const HandEstimate hint = painted_hand_estimate(kX, kY, kZ);
  for (const bool colour : {true, false}) {
    PaintedScene scene;
    scene.hand(kX, kY, kZ).forearm(kX, kY, kZ, test::kSkin);
    if (!colour) scene.no_colour();
    const auto o = observe(scene, &hint);
    EXPECT_EQ(label_at(*o, kX, kY - 0.01, kZ), PixelLabel::hand);
    EXPECT_EQ(label_at(*o, kX, kY + 0.03, kZ), PixelLabel::object);
  }
}

TEST(Preprocess, WristCutFollowsAHandThatMovedSinceTheHint) {
  const HandEstimate hint = painted_hand_estimate(kX - 0.1, kY + 0.02, kZ + 0.03);
  PaintedScene scene;
  scene.hand(kX, kY, kZ).forearm(kX, kY, kZ, test::kSkin);
  Preprocessor preprocessor{PreprocessParams{}};
  const auto o = *preprocessor.process(scene.share(2), &hint);
  EXPECT_EQ(label_at(*o, kX, kY - 0.01, kZ), PixelLabel::hand);
  EXPECT_EQ(label_at(*o, kX, kY + 0.035, kZ), PixelLabel::object);
  EXPECT_EQ(label_at(*o, kX + 0.0315, kY - 0.16, kZ), PixelLabel::hand);
}

TEST(Preprocess, SleeveIsNotHand) {
  const auto o = observe(PaintedScene().hand(kX, kY, kZ).forearm(kX, kY, kZ, test::kBlue));
  EXPECT_EQ(label_at(*o, kX, kY - 0.01, kZ), PixelLabel::hand);
  EXPECT_EQ(label_at(*o, kX, kY + 0.02, kZ), PixelLabel::object);
}

TEST(Preprocess, WhereColourIsBlackTheConnectedSurfaceDecides) {
  // Lower palm without colour belongs to the palm; the sleeve without colour belongs to the sleeve.
  const auto o = observe(PaintedScene()
                             .hand(kX, kY, kZ)
                             .forearm(kX, kY, kZ, test::kBlue)
                             .patch(kX - 0.04, kY - 0.05, kX + 0.04, kY - 0.03, kZ, test::kBlack)
                             .patch(kX - 0.027, kY + 0.03, kX + 0.027, 1, kZ, test::kBlack));
  EXPECT_EQ(label_at(*o, kX, kY - 0.04, kZ), PixelLabel::hand);
  EXPECT_NE(label_at(*o, kX, kY + 0.05, kZ), PixelLabel::hand);
}

TEST(Preprocess, ColourSkewedByTwoPixelsLeavesTheSilhouetteToDepth) {
  PaintedScene scene;
  scene.hand(kX, kY, kZ);
  PaintedScene skewed;
  skewed.hand(kX + 2 * kZ / 240, kY, kZ);
  scene.frame().colour = skewed.frame().colour;
  const auto truth = observe(PaintedScene().hand(kX, kY, kZ));
  EXPECT_NEAR(observe(scene)->hand_pixels.size(), truth->hand_pixels.size(), 0.01 * truth->hand_pixels.size());
}

TEST(Preprocess, GreyishSkinInShadowJoinsTheSkinAndNotTheSleeve) {
  const Rgb shadow{132, 115, 119};
  const auto o = observe(PaintedScene()
                             .hand(kX, kY, kZ, Rgb{145, 112, 108})
                             .forearm(kX, kY, kZ, test::kBlue)
                             .patch(kX - 0.04, kY - 0.03, kX + 0.04, kY, kZ, shadow));
  EXPECT_EQ(label_at(*o, kX, kY - 0.008, kZ), PixelLabel::hand);
  EXPECT_EQ(label_at(*o, kX, kY + 0.015, kZ), PixelLabel::object);
}

TEST(Preprocess, WithoutColourAPlateBeforeTheFingersIsNeitherHandNorDragsItAlong) {
  const HandEstimate hint = painted_hand_estimate(kX, kY, kZ);
  PaintedScene scene;
  scene.hand(kX, kY, kZ).forearm(kX, kY, kZ, test::kSkin).patch(-0.3, -1, 0.3, -0.03, 0.42, test::kGreen).no_colour();
  const auto o = observe(scene, &hint);
  EXPECT_EQ(label_at(*o, 0, -0.06, 0.42), PixelLabel::object);
  EXPECT_EQ(label_at(*o, kX, kY - 0.01, kZ), PixelLabel::hand);
  EXPECT_EQ(label_at(*o, kX, kY + 0.04, kZ), PixelLabel::object);
}

TEST(Preprocess, GreyImageCountsAsNoColour) {
  const auto o = observe(PaintedScene(1.2f, test::kGrey).hand(kX, kY, kZ, Rgb{150, 150, 150}));
  EXPECT_TRUE(o->hand_present);
  EXPECT_EQ(label_at(*o, kX, kY - 0.04, kZ), PixelLabel::hand);
}

TEST(Preprocess, FlyingPixelsBetweenHandAndWallAreUnknown) {
  PaintedScene scene;
  scene.hand(kX, kY, kZ);
  const int u = static_cast<int>(160 + 0.04 * 480) + 1;  // right of the palm, below the thumb
  for (int v = 135; v < 147; ++v) scene.frame().depth.at(u, v) = 8000;
  const auto o = observe(scene);
  EXPECT_EQ(o->label.at(u - o->u0, 140 - o->v0), PixelLabel::unknown);
}

TEST(Preprocess, EmptyFrameHasNoHand) {
  PaintedScene scene;
  scene.erase_depth(0, 0, 320, 240);
  const auto o = observe(scene);
  EXPECT_FALSE(o->hand_present);
  EXPECT_TRUE(o->hand_pixels.empty());
  EXPECT_FALSE(observe(PaintedScene())->hand_present);  // a wall alone
}

TEST(Preprocess, WrongSizesAndMissingIntrinsicsAreErrors) {
  Preprocessor preprocessor{PreprocessParams{}};
  PaintedScene colour, depth, camera;
  colour.frame().colour.reset(160, 120);
  depth.frame().depth.reset(160, 120);
  camera.frame().camera.fx = 0;
  for (const PaintedScene& bad : {colour, depth, camera}) {
    const auto result = preprocessor.process(bad.share(7), nullptr);
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().where, "frame 7");
  }
}

TEST(Preprocess, SkinModelFollowsAShiftedWhiteBalance) {
  // Light turns blue in small steps until the generic model alone calls the skin something else.
  const auto lit = [](Rgb c, int step) {
    return Rgb{static_cast<std::uint8_t>(c.r * (1 - 0.012 * step)), c.g,
               static_cast<std::uint8_t>(c.b * (1 + 0.02 * step))};
  };
  constexpr int kSteps = 35;
  const HandEstimate estimate = painted_hand_estimate(kX, kY, kZ);
  const auto scene = [&](int step) {
    return PaintedScene(1.2f, lit(Rgb{110, 130, 100}, step)).hand(kX, kY, kZ, lit(test::kSkin, step));
  };
  ASSERT_FALSE(observe(scene(kSteps))->hand_present);
  Preprocessor preprocessor{PreprocessParams{}};
  HandObservationPtr o;
  for (int frame = 0; frame <= 6 * kSteps; ++frame) {
    HandEstimate hint = painted_hand_estimate(kX, kY, kZ, frame - 2);
    o = *preprocessor.process(scene(frame / 6).share(frame), &hint);
  }
  ASSERT_TRUE(o->hand_present);
  EXPECT_EQ(label_at(*o, kX, kY - 0.04, kZ), PixelLabel::hand);
  EXPECT_EQ(label_at(*o, kX + 0.0315, kY - 0.16, kZ), PixelLabel::hand);
}

TEST(Preprocess, SameFramesGiveSameObservations) {
  Preprocessor a{PreprocessParams{}}, b{PreprocessParams{}};
  for (int frame = 0; frame < 3; ++frame) {
    const HandEstimate hint = painted_hand_estimate(kX, kY, kZ, frame - 2);
    const auto scene = PaintedScene().hand(kX + 0.01 * frame, kY, kZ).forearm(kX + 0.01 * frame, kY, kZ, test::kSkin);
    const auto first = *a.process(scene.share(frame), &hint);
    const auto second = *b.process(scene.share(frame), &hint);
    ASSERT_EQ(first->label.size(), second->label.size());
    for (std::size_t i = 0; i < first->label.size(); ++i) {
      ASSERT_EQ(first->label[i], second->label[i]);
      ASSERT_EQ(first->depth[i], second->depth[i]);
      ASSERT_EQ(first->nearest_hand[i], second->nearest_hand[i]);
      ASSERT_EQ(first->normal[i], second->normal[i]);
    }
    EXPECT_EQ(first->cloud, second->cloud);
    EXPECT_EQ(first->noise, second->noise);
  }
}

TEST(Preprocess, CloudIsThinnedEvenlyAndLiesOnTheHand) {
  const auto o = observe(PaintedScene().hand(kX, kY, 0.3));
  EXPECT_GT(o->cloud.size(), 400u);
  EXPECT_LE(o->cloud.size(), 900u);
  for (const Eigen::Vector3f& p : o->cloud) EXPECT_NEAR(p.z(), 0.3f, 1e-4f);
}

TEST(Preprocess, ResultsSurviveThePreprocessor) {
  HandObservationPtr kept;
  {
    Preprocessor preprocessor{PreprocessParams{}};
    kept = *preprocessor.process(PaintedScene().hand(kX, kY, kZ).share(), nullptr);
    const auto later = *preprocessor.process(PaintedScene().hand(kX + 0.05, kY, kZ).share(), nullptr);
    EXPECT_NE(kept.get(), later.get());
  }
  EXPECT_EQ(label_at(*kept, kX, kY - 0.04, kZ), PixelLabel::hand);
}

}  // namespace
}  // namespace barehand
