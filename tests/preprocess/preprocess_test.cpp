#include "stages/preprocess/preprocess.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/preprocess/painted_scene.h"

namespace barehand {
namespace {

using test::label_at;
using test::painted_hand_estimate;
using test::PaintedScene;
constexpr double kX = 0.0, kY = 0.06, kZ = 0.5;  // position of the wrist [m]

/// The observation of the only hand that is searched for. `earlier` is the estimate of the previous frame.
HandObservationPtr process(Preprocessor& preprocessor, const FramePtr& frame, const HandEstimate* earlier = nullptr) {
  HandEstimates feedback;
  if (earlier) feedback.push_back(std::make_shared<HandEstimate>(*earlier));
  const Result<HandObservations> result = preprocessor.process(frame, feedback);
  EXPECT_TRUE(result.has_value() && result->size() == 1);
  return result->front();
}

HandObservationPtr observe(const PaintedScene& scene, const HandEstimate* earlier = nullptr) {
  Preprocessor preprocessor{PreprocessParams{}};
  return process(preprocessor, scene.share(), earlier);
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

TEST(Preprocess, AFingertipThatShowsBehindAnObjectIsHand) {
  // At this depth, a finger is five pixels wide: all of them are next to depth edges. The object in front is hardly
  // nearer than the fingers.
  constexpr double kFar = 0.8, kTip = kY - 0.18;
  const auto o = observe(PaintedScene()
                             .hand(kX, kY, kFar)
                             .patch(kX - 0.04, kTip + 0.02, kX + 0.04, kTip + 0.07, kFar - 0.006, test::kGreen));
  for (int finger = 0; finger < 4; ++finger) {
    const double x = kX + 0.0315 - 0.021 * finger;
    EXPECT_EQ(label_at(*o, x, kTip + 0.01, kFar), PixelLabel::hand) << finger;
    EXPECT_EQ(label_at(*o, x, kTip + 0.04, kFar), PixelLabel::object) << finger;
  }
}

TEST(Preprocess, TheRegionReachesFiveCentimetresBeyondTheHandAndAtLeast48Pixels) {
  constexpr double kPalmEdge = -0.04, kFocal = 240, kCentre = 159.5, kCell = 4, kAligned = 8;
  constexpr double kNear = 0.2, kFar = 0.8;
  const auto near = observe(PaintedScene().hand(kX, kY, kNear)), far = observe(PaintedScene().hand(kX, kY, kFar));
  ASSERT_TRUE(near->hand_present && far->hand_present);
  EXPECT_NEAR(near->u0 + kAligned / 2, kCentre + kFocal * (kPalmEdge - 0.05) / kNear, kCell + kAligned / 2);
  EXPECT_NEAR(far->u0 + kAligned / 2, kCentre + kFocal * kPalmEdge / kFar - 48, kCell + kAligned / 2);
}

TEST(Preprocess, TheTrackerLooksAtTheSamePixelsWhateverTheMargin) {
  PreprocessParams params;
  for (params.margin = 0.05; params.margin < 0.07; params.margin += 0.003) {
    Preprocessor preprocessor{params};
    const auto o = process(preprocessor, PaintedScene().hand(kX, kY, 0.3).share());
    EXPECT_EQ(o->u0 % 8, 0) << params.margin;
    EXPECT_EQ(o->v0 % 8, 0) << params.margin;
  }
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
  const HandEstimate earlier = painted_hand_estimate(kX, kY, kZ);
  for (const bool colour : {true, false}) {
    PaintedScene scene;
    scene.hand(kX, kY, kZ).forearm(kX, kY, kZ, test::kSkin);
    if (!colour) scene.no_colour();
    const auto o = observe(scene, &earlier);
    EXPECT_EQ(label_at(*o, kX, kY - 0.01, kZ), PixelLabel::hand);
    EXPECT_EQ(label_at(*o, kX, kY + 0.03, kZ), PixelLabel::object);
  }
}

TEST(Preprocess, WristCutFollowsAHandThatMovedSinceTheHint) {
  const HandEstimate earlier = painted_hand_estimate(kX - 0.1, kY + 0.02, kZ + 0.03);
  PaintedScene scene;
  scene.hand(kX, kY, kZ).forearm(kX, kY, kZ, test::kSkin);
  Preprocessor preprocessor{PreprocessParams{}};
  const auto o = process(preprocessor, scene.share(2), &earlier);
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
  const HandEstimate earlier = painted_hand_estimate(kX, kY, kZ);
  PaintedScene scene;
  scene.hand(kX, kY, kZ).forearm(kX, kY, kZ, test::kSkin).patch(-0.3, -1, 0.3, -0.03, 0.42, test::kGreen).no_colour();
  const auto o = observe(scene, &earlier);
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
  EXPECT_FALSE(observe(PaintedScene())->hand_present);  // only a wall
}

TEST(Preprocess, WrongSizesAndMissingIntrinsicsAreErrors) {
  Preprocessor preprocessor{PreprocessParams{}};
  PaintedScene colour, depth, camera;
  colour.frame().colour.reset(160, 120);
  depth.frame().depth.reset(160, 120);
  camera.frame().camera.fx = 0;
  for (const PaintedScene& bad : {colour, depth, camera}) {
    const auto result = preprocessor.process(bad.share(7), {});
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().where, "frame 7");
  }
}

TEST(Preprocess, SkinModelFollowsAShiftedWhiteBalance) {
  // The light becomes bluer in small steps, until the general skin model alone would not recognise the skin.
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
    HandEstimate earlier = painted_hand_estimate(kX, kY, kZ, frame - 2);
    o = process(preprocessor, scene(frame / 6).share(frame), &earlier);
  }
  ASSERT_TRUE(o->hand_present);
  EXPECT_EQ(label_at(*o, kX, kY - 0.04, kZ), PixelLabel::hand);
  EXPECT_EQ(label_at(*o, kX + 0.0315, kY - 0.16, kZ), PixelLabel::hand);
}

TEST(Preprocess, SameFramesGiveSameObservations) {
  Preprocessor a{PreprocessParams{}}, b{PreprocessParams{}};
  for (int frame = 0; frame < 3; ++frame) {
    const HandEstimate earlier = painted_hand_estimate(kX, kY, kZ, frame - 2);
    const auto scene = PaintedScene().hand(kX + 0.01 * frame, kY, kZ).forearm(kX + 0.01 * frame, kY, kZ, test::kSkin);
    const auto first = process(a, scene.share(frame), &earlier);
    const auto second = process(b, scene.share(frame), &earlier);
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
    kept = process(preprocessor, PaintedScene().hand(kX, kY, kZ).share());
    const auto later = process(preprocessor, PaintedScene().hand(kX + 0.05, kY, kZ).share());
    EXPECT_NE(kept.get(), later.get());
  }
  EXPECT_EQ(label_at(*kept, kX, kY - 0.04, kZ), PixelLabel::hand);
}

/// The observations of two hands. `first` and `second` are the estimates of the previous frame, or null.
HandObservations observe_two(const PaintedScene& scene, const HandEstimate* first, const HandEstimate* second) {
  Preprocessor preprocessor{PreprocessParams{}, 2};
  HandEstimates feedback;
  for (const HandEstimate* earlier : {first, second})
    feedback.push_back(std::make_shared<HandEstimate>(earlier ? *earlier : HandEstimate{}));
  const auto result = preprocessor.process(scene.share(2), feedback);
  EXPECT_TRUE(result.has_value() && result->size() == 2);
  return *result;
}

constexpr double kLeftX = -0.11, kRightX = 0.11;

TEST(PreprocessTwoHands, EveryHintFindsItsOwnHand) {
  const HandEstimate left = painted_hand_estimate(kLeftX, kY, kZ), right = painted_hand_estimate(kRightX, kY, kZ);
  const auto o = observe_two(PaintedScene().hand(kLeftX, kY, kZ).hand(kRightX, kY, kZ), &right, &left);
  for (int k = 0; k < 2; ++k) {
    const double own = k == 0 ? kRightX : kLeftX, other = -own;
    EXPECT_TRUE(o[k]->followed);
    EXPECT_EQ(label_at(*o[k], own, kY - 0.04, kZ), PixelLabel::hand);
    EXPECT_NE(label_at(*o[k], other, kY - 0.04, kZ), PixelLabel::hand);
  }
}

TEST(PreprocessTwoHands, HandsSideBySideAtOneDepthAreToldApartByTheirHints) {
  // The thumb of the left hand touches the palm of the other, so that both hands are one surface.
  constexpr double kGap = 0.125;
  const HandEstimate left = painted_hand_estimate(-kGap / 2, kY, kZ), right = painted_hand_estimate(kGap / 2, kY, kZ);
  const auto o = observe_two(PaintedScene().hand(-kGap / 2, kY, kZ).hand(kGap / 2, kY, kZ), &left, &right);
  for (int k = 0; k < 2; ++k) {
    const double own = k == 0 ? -kGap / 2 : kGap / 2;
    EXPECT_EQ(label_at(*o[k], own, kY - 0.04, kZ), PixelLabel::hand);
    EXPECT_EQ(label_at(*o[k], own + 0.0315, kY - 0.15, kZ), PixelLabel::hand) << "finger";
    EXPECT_NE(label_at(*o[k], -own, kY - 0.04, kZ), PixelLabel::hand);
  }
}

TEST(PreprocessTwoHands, NoPixelIsAHandTwice) {
  for (const double gap : {0.10, 0.125}) {
    const HandEstimate left = painted_hand_estimate(-gap / 2, kY, kZ), right = painted_hand_estimate(gap / 2, kY, kZ);
    const auto o = observe_two(PaintedScene().hand(-gap / 2, kY, kZ).hand(gap / 2, kY, kZ), &left, &right);
    std::set<std::pair<int, int>> seen;
    std::size_t pixels = 0;
    for (const HandObservationPtr& one : o)
      for (const std::int32_t i : one->hand_pixels) {
        seen.insert({i % one->depth.width() + one->u0, i / one->depth.width() + one->v0});
        ++pixels;
      }
    EXPECT_GT(pixels, 2000u);
    EXPECT_EQ(seen.size(), pixels) << gap;
  }
}

TEST(PreprocessTwoHands, TheOneInFrontIsNoPartOfTheOneBehind) {
  const HandEstimate behind = painted_hand_estimate(0, kY, kZ), front = painted_hand_estimate(0.03, kY, kZ - 0.09);
  const auto o = observe_two(PaintedScene().hand(0, kY, kZ).hand(0.03, kY, kZ - 0.09), &behind, &front);
  EXPECT_TRUE(o[0]->followed && o[1]->followed);
  EXPECT_EQ(label_at(*o[0], 0.03, kY - 0.04, kZ - 0.09), PixelLabel::object) << "hides it";
  EXPECT_EQ(label_at(*o[0], -0.03, kY - 0.04, kZ), PixelLabel::hand);
  EXPECT_EQ(label_at(*o[1], 0.03, kY - 0.04, kZ - 0.09), PixelLabel::hand);
  EXPECT_NE(label_at(*o[1], -0.03, kY - 0.04, kZ), PixelLabel::hand);
}

TEST(PreprocessTwoHands, WithoutHintsBothAreFoundAndNeitherTwice) {
  const auto o = observe_two(PaintedScene().hand(kLeftX, kY, kZ).hand(kRightX, kY, kZ), nullptr, nullptr);
  ASSERT_TRUE(o[0]->hand_present && o[1]->hand_present);
  EXPECT_FALSE(o[0]->followed || o[1]->followed);
  const bool first_is_left = label_at(*o[0], kLeftX, kY - 0.04, kZ) == PixelLabel::hand;
  EXPECT_EQ(label_at(*o[first_is_left ? 1 : 0], kRightX, kY - 0.04, kZ), PixelLabel::hand);
  EXPECT_NEAR(o[0]->hand_pixels.size(), o[1]->hand_pixels.size(), 100);
}

TEST(PreprocessTwoHands, TheForearmOfATrackedHandIsNoHand) {
  const HandEstimate tracked = painted_hand_estimate(0, 0.0, kZ);
  const auto o = observe_two(PaintedScene().hand(0, 0.0, kZ).forearm(0, 0.0, kZ, test::kSkin), &tracked, nullptr);
  EXPECT_TRUE(o[0]->followed);
  EXPECT_FALSE(o[1]->hand_present);
}

TEST(PreprocessTwoHands, AHandThatIsHeldIsItsOwnAlsoIfItIsTheOnlyOne) {
  HandEstimate held = painted_hand_estimate(0, kY, kZ);
  held.status = TrackStatus::holding;
  const auto o = observe_two(PaintedScene().hand(0, kY, kZ), nullptr, &held);
  EXPECT_TRUE(o[1]->followed);
  EXPECT_FALSE(o[0]->hand_present);
}

TEST(PreprocessTwoHands, AHandThatIsGoneDoesNotTakeTheOtherOnesPlace) {
  const HandEstimate gone = painted_hand_estimate(0.02, kY, kZ), tracked = painted_hand_estimate(-0.06, kY, kZ);
  const auto o = observe_two(PaintedScene().hand(-0.06, kY, kZ), &gone, &tracked);
  EXPECT_TRUE(o[1]->followed);
  EXPECT_EQ(label_at(*o[1], -0.06, kY - 0.04, kZ), PixelLabel::hand);
  EXPECT_NE(label_at(*o[0], -0.06, kY - 0.04, kZ), PixelLabel::hand);
}

}  // namespace
}  // namespace barehand
