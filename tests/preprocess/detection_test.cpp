// Tests how the labels of a detection separate a hand from an object that it touches, which depth alone cannot do.
#include <gtest/gtest.h>

#include "preprocess/painted_scene.h"
#include "stages/preprocess/preprocess.h"

namespace barehand {
namespace {

using test::label_at;
using test::PaintedScene;

constexpr double kZ = 0.5;

/// A hand with a forearm and a body at the same depth. Together they are one surface of 0.2 m^2.
PaintedScene person() {
  PaintedScene scene;
  scene.patch(-0.02, -0.05, 0.3, 1, kZ, test::kBlue).hand(-0.1, 0.05, kZ).forearm(-0.1, 0.05, kZ, test::kBlue);
  return scene.no_colour();
}

/// An ideal detection of that hand: within the hand's outline, pixels above the wrist (y = 0.05) are labelled as hand.
DetectionPtr detected(const PaintedScene& scene, double x = -0.1) {
  const Intrinsics camera = scene.share()->camera;
  DetectedHand hand;
  hand.centre = {x, 0, kZ};
  for (DetectedJoint& joint : hand.joints) joint.position = {x, 0, kZ};
  hand.joints[kWristLandmark].position = {x, 0.05, kZ};
  hand.joints[kMiddleKnuckleLandmark].position = {x, -0.04, kZ};
  LabelMap& labels = hand.labels;
  labels.step_u = labels.step_v = 4;
  const Eigen::Vector2d corner = camera.project({x - 0.17, -0.17, kZ});
  labels.u0 = corner.x();
  labels.v0 = corner.y();
  labels.label.reset(42, 42);
  labels.hand_log_odds.reset(42, 42, -4.f);
  for (int r = 0; r < 42; ++r)
    for (int c = 0; c < 42; ++c) {
      const Eigen::Vector3d p = camera.unproject(labels.u0 + 4 * c, labels.v0 + 4 * r, kZ);
      const bool is_hand = p.y() < 0.05 && p.y() > -0.14 && std::abs(p.x() - x) < 0.045;
      labels.label.at(c, r) = is_hand ? SurfaceLabel::hand : p.y() < 0.1 ? SurfaceLabel::background : SurfaceLabel::arm;
      labels.hand_log_odds.at(c, r) = is_hand ? 4.f : -4.f;
    }
  auto detection = std::make_shared<Detection>();
  detection->whole_frame = true;
  detection->hands.push_back(hand);
  return detection;
}

class DetectionMask : public ::testing::Test {
 protected:
  HandObservationPtr observe(const PaintedScene& scene, const DetectionPtr& detection,
                             std::vector<HandEstimatePtr> feedback = {}, int number = 0) {
    const auto result = preprocessor_.process(scene.share(number), feedback, detection);
    EXPECT_TRUE(result);
    return result->front();
  }
  static void expect_hand_alone(const HandObservation& o) {
    ASSERT_TRUE(o.hand_present);
    EXPECT_EQ(label_at(o, -0.1, 0.0, kZ), PixelLabel::hand);       // palm
    EXPECT_EQ(label_at(o, -0.1315, -0.08, kZ), PixelLabel::hand);  // index finger
    EXPECT_NE(label_at(o, -0.1, 0.09, kZ), PixelLabel::hand);      // forearm
    EXPECT_NE(label_at(o, -0.01, 0.03, kZ), PixelLabel::hand);     // body
  }
  Preprocessor preprocessor_{PreprocessParams{}};
};

TEST_F(DetectionMask, AHandThatIsOneSurfaceWithArmAndBodyIsFoundByItsLabelsOnly) {
  EXPECT_FALSE(observe(person(), nullptr)->hand_present);
  const auto observation = observe(person(), detected(person()));
  expect_hand_alone(*observation);
  ASSERT_TRUE(observation->detected);
  EXPECT_EQ(observation->detected->centre.x(), -0.1);
}

TEST_F(DetectionMask, ItStaysSoWhileItIsTracked) {
  const auto earlier = std::make_shared<const HandEstimate>(test::painted_hand_estimate(-0.1, 0.05, kZ));
  const auto detection = std::make_shared<Detection>(*detected(person()));
  detection->whole_frame = false;
  const auto observation = observe(person(), detection, {earlier}, 2);
  EXPECT_TRUE(observation->followed);
  expect_hand_alone(*observation);
  EXPECT_TRUE(observation->detected);
}

TEST_F(DetectionMask, WhereTheWholeFrameShowsNoHandASurfaceOfItsSizeIsNone) {
  PaintedScene alone;
  alone.hand(0, 0.05, kZ).no_colour();
  EXPECT_TRUE(observe(alone, nullptr)->hand_present);
  auto nothing = std::make_shared<Detection>();
  nothing->whole_frame = true;
  EXPECT_FALSE(observe(alone, nothing)->hand_present);
}

TEST_F(DetectionMask, WithoutColourATrackedHandThatTheNetworksDoNotSeeHasSlipped) {
  const auto earlier = std::make_shared<const HandEstimate>(test::painted_hand_estimate(-0.1, 0.05, kZ));
  const PaintedScene alone = PaintedScene().hand(-0.1, 0.05, kZ).no_colour();
  auto nothing = std::make_shared<Detection>();
  EXPECT_TRUE(observe(alone, nothing, {earlier}, 1)->followed);  // they did not look
  nothing->around_tracked = true;
  EXPECT_FALSE(observe(alone, nothing, {earlier}, 2)->hand_present);
  EXPECT_TRUE(observe(PaintedScene().hand(-0.1, 0.05, kZ), nothing, {earlier}, 3)->followed);  // colour shows it

  // It is taken up where they see a hand instead.
  PaintedScene two;
  two.hand(-0.1, 0.05, kZ).hand(0.15, 0.05, kZ).no_colour();
  auto elsewhere = std::make_shared<Detection>(*detected(two, 0.15));
  elsewhere->whole_frame = false;
  elsewhere->around_tracked = true;
  const auto o = observe(two, elsewhere, {earlier}, 4);
  ASSERT_TRUE(o->hand_present && o->detected);
  EXPECT_FALSE(o->followed);
  EXPECT_EQ(o->detected->centre.x(), 0.15);
}

TEST_F(DetectionMask, TwoHandsThatAreSearchedForGetOneDetectedHandEach) {
  PaintedScene scene;
  scene.hand(-0.1, 0.05, kZ).hand(0.15, 0.05, kZ).no_colour();
  auto detection = std::make_shared<Detection>(*detected(scene, -0.1));
  detection->hands.push_back(detected(scene, 0.15)->hands[0]);
  Preprocessor both(PreprocessParams{}, 2);
  const auto result = both.process(scene.share(), {}, detection);
  ASSERT_TRUE(result);
  ASSERT_TRUE((*result)[0]->detected && (*result)[1]->detected);
  EXPECT_NE((*result)[0]->detected, (*result)[1]->detected);
}

TEST_F(DetectionMask, ADetectedHandOutOfTheWorkingRangeIsNotTaken) {
  auto detection = std::make_shared<Detection>(*detected(person()));
  detection->hands[0].centre.z() = 2;
  EXPECT_FALSE(observe(person(), detection)->hand_present);
}

/// That hand alone, and with a plate of the colour of skin beside its fingers, at the same depth.
PaintedScene bare_hand() { return PaintedScene().hand(-0.1, 0.05, kZ); }
PaintedScene hand_with_plate() { return bare_hand().patch(-0.06, -0.15, 0.06, -0.02, kZ, test::kSkin); }

TEST_F(DetectionMask, LabelsTellAThingOfTheColourOfSkinFromTheHandAsLongAsItTouchesIt) {
  const auto earlier = std::make_shared<const HandEstimate>(test::painted_hand_estimate(-0.1, 0.05, kZ));
  const auto labels = std::make_shared<Detection>(*detected(bare_hand()));
  labels->whole_frame = false;
  const auto is_hand = [](const HandObservation& o, double x) { return label_at(o, x, -0.08, kZ) == PixelLabel::hand; };

  observe(bare_hand(), nullptr, {earlier}, 1);
  EXPECT_FALSE(preprocessor_.needs_labels());

  // Colour alone leaves a strip of the plate in the mask.
  EXPECT_TRUE(is_hand(*observe(hand_with_plate(), nullptr, {earlier}, 2), -0.05));
  EXPECT_TRUE(preprocessor_.needs_labels());

  const auto o = observe(hand_with_plate(), labels, {earlier}, 3);
  EXPECT_FALSE(is_hand(*o, -0.05));
  EXPECT_TRUE(is_hand(*o, -0.1315));
  EXPECT_TRUE(preprocessor_.needs_labels());

  observe(bare_hand(), labels, {earlier}, 4);
  EXPECT_FALSE(preprocessor_.needs_labels());
}

TEST_F(DetectionMask, LabelsAreNeededIfColourIsNotUsed) {
  PreprocessParams params;
  params.use_colour = false;
  EXPECT_TRUE(Preprocessor(params, 1).needs_labels());
}

TEST_F(DetectionMask, AtAStartSkinThatIsLabelledAsObjectIsHandOnItsBonesOnly) {
  const auto detection = std::make_shared<Detection>(*detected(bare_hand()));
  LabelMap& labels = detection->hands[0].labels;
  labels.label.reset(labels.label.width(), labels.label.height(), SurfaceLabel::object);
  const auto o = observe(hand_with_plate(), detection);
  EXPECT_EQ(label_at(*o, -0.1, 0.02, kZ), PixelLabel::hand);
  EXPECT_NE(label_at(*o, 0.02, -0.08, kZ), PixelLabel::hand);
}

/// A hand in a glove, with a bare forearm, before a body.
PaintedScene gloved_person(Rgb glove = test::kGreen) {
  PaintedScene scene;
  return scene.patch(-0.02, -0.05, 0.3, 1, kZ, test::kBlue)
      .hand(-0.1, 0.05, kZ, glove)
      .forearm(-0.1, 0.05, kZ, test::kSkin);
}

TEST_F(DetectionMask, AGlovedHandIsFoundByDepthAndFollowedSo) {
  const DetectionPtr detection = detected(gloved_person());
  expect_hand_alone(*observe(gloved_person(), detection));
  EXPECT_TRUE(preprocessor_.needs_labels());

  // The tracker's estimate is of the frame in which the hand was found. In between, the networks saw skin alone.
  const auto earlier = std::make_shared<const HandEstimate>(test::painted_hand_estimate(-0.1, 0.05, kZ));
  auto skin = std::make_shared<Detection>(*detection);
  skin->hands[0].skin_only = true;
  EXPECT_FALSE(observe(gloved_person(), skin, {}, 1)->hand_present);
  const auto observation = observe(gloved_person(), detection, {earlier}, 2);
  EXPECT_TRUE(observation->followed);
  expect_hand_alone(*observation);

  // The next estimate is of the frame in between. The hand is followed as it was found, even in a glove whose colour
  // was not learned yet.
  const auto between = std::make_shared<const HandEstimate>(test::painted_hand_estimate(-0.1, 0.05, kZ, 1));
  expect_hand_alone(*observe(gloved_person(test::kBlue), detection, {between}, 3));
}

TEST_F(DetectionMask, AGlovesColourIsLearnedInTheEnd) {
  const DetectionPtr detection = detected(gloved_person());
  observe(gloved_person(), detection);
  int number = 1;
  for (; number < 300 && preprocessor_.needs_labels(); ++number) {
    const auto earlier = std::make_shared<const HandEstimate>(test::painted_hand_estimate(-0.1, 0.05, kZ, number - 1));
    expect_hand_alone(*observe(gloved_person(), detection, {earlier}, number));
  }
  EXPECT_LT(number, 300);
}

TEST_F(DetectionMask, WhereColourShowsTheHandItIsUsed) {
  observe(bare_hand(), detected(bare_hand()));
  EXPECT_FALSE(preprocessor_.needs_labels());
}

}  // namespace
}  // namespace barehand
