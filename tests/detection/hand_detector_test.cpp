#include "stages/detection/hand_detector.h"

#include <cmath>
#include <thread>

#include "math/angles.h"
#include "support/rendered_person.h"

extern "C" void omp_set_num_threads(int);  // of libgomp, which oneDNN uses

namespace barehand {
namespace {

/// Tests the shipped networks on a person's open hand. The hand is 0.6 m from the camera, in front of the body.
class HandDetectorTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto detector = HandDetector::load(std::string(BAREHAND_CONFIGS) + "/nets", DetectionParams{});
    ASSERT_TRUE(detector) << detector.error().message();
    detector_ = std::make_unique<HandDetector>(std::move(*detector));
  }

  /// Pose with the fingers up and the palm towards the camera, at `x` and `distance` [m].
  static HandPose open_hand(const HandProfile& profile, double x = 0, double distance = 0.6) {
    HandPose pose = test::facing_pose(profile, distance);
    for (SE3& T : pose) T.t.x() += x;
    return pose;
  }
  static void add_body(test::RenderedPerson& person) { person.box(0.15, 0.25, 0.95, 0.45, 0.7); }
  static void add_hand(const HandProfile& profile, const HandPose& pose, test::RenderedPerson& person) {
    person.hand(profile, pose, pose[kPalm].t + Eigen::Vector3d(0.05, 0.14, 0.17));
  }

  Detection detect(const RgbdFrame& frame) { return detect(frame, workers_); }
  Detection detect(const RgbdFrame& frame, Workers& workers) {
    auto detection = detector_->detect(frame, workers);
    EXPECT_TRUE(detection) << detection.error().message();
    return detection.value_or(Detection{});
  }

  static double mean_error(const DetectedHand& hand, const HandProfile& profile, const HandPose& pose) {
    const auto truth = test::landmarks(profile, pose);
    double sum = 0;
    for (int k = 0; k < kLandmarkCount; ++k) sum += (hand.joints[k].position - truth[k]).norm() / kLandmarkCount;
    return sum;
  }

  Workers workers_{1};
  std::unique_ptr<HandDetector> detector_;
  std::shared_ptr<const HandProfile> right_ = test::adult_hand();
};

TEST_F(HandDetectorTest, FindsTheHandOfAPersonWhoseArmJoinsTheBody) {
  const HandPose pose = open_hand(*right_);
  test::RenderedPerson person(test::vga_camera());
  add_body(person);
  add_hand(*right_, pose, person);
  const Detection detection = detect(*person.frame());
  ASSERT_EQ(detection.hands.size(), 1u);
  EXPECT_LT(mean_error(detection.hands[0], *right_, pose), 0.02);
  EXPECT_GT(detection.hands[0].right_log_odds, 1);
}

TEST_F(HandDetectorTest, LabelsTheHandButNeitherArmNorBody) {
  const Intrinsics camera = test::vga_camera();
  const HandPose pose = open_hand(*right_);
  test::RenderedPerson person(camera);
  add_body(person);
  add_hand(*right_, pose, person);
  const auto frame = person.frame();
  const Detection detection = detect(*frame);
  ASSERT_EQ(detection.hands.size(), 1u);
  const LabelMap& labels = detection.hands[0].labels;

  int hand = 0, hand_found = 0, rest = 0, rest_found = 0;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      if (!labels.covers(u, v)) continue;
      const bool labelled = labels.at(u, v) == SurfaceLabel::hand;
      if (person.is_hand(u, v)) ++hand, hand_found += labelled;
      if (!person.is_hand(u, v)) ++rest, rest_found += labelled;
    }
  EXPECT_GT(hand_found, 0.9 * hand);
  EXPECT_LT(rest_found, 0.05 * rest);
}

TEST_F(HandDetectorTest, SpreadsSayHowFarTheJointsAreOff) {
  const HandPose pose = open_hand(*right_);
  test::RenderedPerson person(test::vga_camera());
  add_hand(*right_, pose, person);
  const Detection detection = detect(*person.frame());
  ASSERT_EQ(detection.hands.size(), 1u);
  const auto truth = test::landmarks(*right_, pose);
  double distance_sq = 0;
  for (int k = 0; k < kLandmarkCount; ++k) {
    const DetectedJoint& joint = detection.hands[0].joints[k];
    const Eigen::Vector3d error = joint.position - truth[k];
    distance_sq += error.dot(joint.covariance.ldlt().solve(error)) / kLandmarkCount;
    EXPECT_GT(joint.covariance.ldlt().vectorD().minCoeff(), 0);
    EXPECT_LT(std::sqrt(joint.covariance.trace()), 0.1);
  }
  EXPECT_GT(distance_sq, 0.3);  // 3 on average if the covariances are right
  EXPECT_LT(distance_sq, 12);
}

TEST_F(HandDetectorTest, ALeftHandIsOneAndItsJointsAreNotMirrored) {
  const auto left = test::adult_hand(Handedness::left);
  const HandPose pose = open_hand(*left);
  test::RenderedPerson person(test::vga_camera());
  add_body(person);
  add_hand(*left, pose, person);
  const Detection detection = detect(*person.frame());
  ASSERT_EQ(detection.hands.size(), 1u);
  EXPECT_LT(detection.hands[0].right_log_odds, -1);
  EXPECT_LT(mean_error(detection.hands[0], *left, pose), 0.02);
}

TEST_F(HandDetectorTest, AHandOfAnUnsureSideIsReadAsTheOneThatIsLookedFor) {
  int sure = 0, unsure = 0;
  for (double turn = -90; turn <= 90; turn += 30) {
    test::RenderedPerson person(test::vga_camera());
    add_hand(*right_, test::turned(open_hand(*right_), {0, turn * kDegree, 0}, {0, 0, 0.6}), person);
    for (const Handedness wanted : {Handedness::left, Handedness::right}) {
      const auto detection = detector_->detect(*person.frame(), workers_, {}, wanted);
      ASSERT_TRUE(detection);
      for (const DetectedHand& hand : detection->hands) {
        const bool is_sure = std::abs(hand.right_log_odds) >= 3;
        ++(is_sure ? sure : unsure);
        const Handedness seen = hand.right_log_odds < 0 ? Handedness::left : Handedness::right;
        EXPECT_EQ(hand.side, is_sure ? seen : wanted) << turn;
      }
    }
  }
  EXPECT_GT(sure, 0);
  EXPECT_GT(unsure, 0);
}

TEST_F(HandDetectorTest, TwoHandsAreTwo) {
  const auto left = test::adult_hand(Handedness::left);
  const HandPose right_pose = open_hand(*right_, -0.17), left_pose = open_hand(*left, 0.17);
  test::RenderedPerson person(test::vga_camera());
  add_hand(*right_, right_pose, person);
  add_hand(*left, left_pose, person);
  const Detection detection = detect(*person.frame());
  ASSERT_EQ(detection.hands.size(), 2u);
  for (const DetectedHand& hand : detection.hands) {
    const bool is_right = hand.side == Handedness::right;
    EXPECT_LT(mean_error(hand, is_right ? *right_ : *left, is_right ? right_pose : left_pose), 0.025);
  }
}

/// Cameras with a low resolution and a wide angle, with a view so wide that two crops are needed, with a long focal
/// length, and with pixels that are not square.
class OtherCamera : public HandDetectorTest, public ::testing::WithParamInterface<Intrinsics> {};
INSTANTIATE_TEST_SUITE_P(Cameras, OtherCamera,
                         ::testing::Values(Intrinsics{224, 172, 210, 210, 111.5, 85.5},
                                           Intrinsics{848, 480, 300, 300, 423.5, 239.5},
                                           Intrinsics{1280, 720, 920, 920, 640, 355},
                                           Intrinsics{640, 240, 525, 262, 319.5, 119.5}));

TEST_P(OtherCamera, SeesTheSameHand) {
  const HandPose pose = open_hand(*right_);
  test::RenderedPerson person(GetParam());
  add_hand(*right_, pose, person);
  const Detection detection = detect(*person.frame());
  ASSERT_EQ(detection.hands.size(), 1u);
  EXPECT_LT(mean_error(detection.hands[0], *right_, pose), 0.02);
}

TEST_F(HandDetectorTest, AHandAtTheBorderOfAWideViewIsFound) {
  const Intrinsics wide{848, 480, 300, 300, 423.5, 239.5};
  const HandPose pose = open_hand(*right_, 0.6);
  test::RenderedPerson person(wide);
  add_hand(*right_, pose, person);
  const Detection detection = detect(*person.frame());
  ASSERT_EQ(detection.hands.size(), 1u);
  EXPECT_LT((detection.hands[0].centre - 0.5 * (pose[kPalm].t + pose[segment_of(2, 0)].t)).norm(), 0.03);
}

TEST_F(HandDetectorTest, WithoutAHandThereIsNone) {
  test::RenderedPerson body(test::vga_camera());
  add_body(body);
  body.capsule({-0.2, -0.25, 0.95}, {-0.2, -0.2, 0.95}, 0.1);  // a head
  EXPECT_TRUE(detect(*body.frame()).hands.empty());
  EXPECT_TRUE(detect(*test::RenderedPerson(test::vga_camera()).frame()).hands.empty());

  auto nothing = test::RenderedPerson(test::vga_camera()).frame();
  nothing->depth.reset(640, 480);
  EXPECT_TRUE(detect(*nothing).hands.empty());
}

TEST_F(HandDetectorTest, AnExpectedHandIsLookedAtAndAnEmptyPlaceIsNoHand) {
  const HandPose pose = open_hand(*right_);
  test::RenderedPerson person(test::vga_camera());
  add_hand(*right_, pose, person);
  const auto frame = person.frame();
  const Eigen::Vector3d centre = pose[kPalm].t + Eigen::Vector3d(0.02, -0.07, 0.03);
  const std::vector<ExpectedHand> places = {{{0.4, 0, 0.6}, Handedness::right}, {centre, Handedness::right}};
  const auto detection = detector_->detect_at(*frame, places, workers_);
  ASSERT_TRUE(detection);
  EXPECT_FALSE(detection->whole_frame);
  ASSERT_EQ(detection->hands.size(), 1u);
  EXPECT_LT(mean_error(detection->hands[0], *right_, pose), 0.02);
  EXPECT_TRUE(detection->around_tracked);

  // A place is not examined where a search of the whole frame found a hand: that one here would be another one.
  Detection whole = detect(*frame);
  EXPECT_FALSE(whole.around_tracked);
  ASSERT_EQ(whole.hands.size(), 1u);
  const Eigen::Vector3d found = whole.hands[0].centre;
  whole.hands[0].centre.x() += 0.06;
  const std::vector<ExpectedHand> between = {{found + Eigen::Vector3d(0.03, 0, 0), Handedness::right}};
  const auto both = detector_->detect_at(*frame, between, workers_, whole);
  ASSERT_TRUE(both);
  EXPECT_TRUE(both->whole_frame && both->around_tracked);
  EXPECT_EQ(both->hands.size(), 1u);

  whole.hands[0].centre.x() += 0.06;
  const auto other = detector_->detect_at(*frame, between, workers_, whole);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->hands.size(), 2u);
}

TEST_F(HandDetectorTest, TheNumberOfThreadsChangesNoBit) {
  const auto left = test::adult_hand(Handedness::left);
  test::RenderedPerson person(test::vga_camera());
  add_body(person);
  add_hand(*right_, open_hand(*right_, -0.17), person);
  add_hand(*left, open_hand(*left, 0.17), person);
  const auto frame = person.frame();
  const Detection one = detect(*frame);
  Detection three;
  std::thread([&] {
    omp_set_num_threads(3);
    Workers workers(3);
    three = detect(*frame, workers);
  }).join();

  ASSERT_EQ(one.hands.size(), 2u);
  ASSERT_EQ(three.hands.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < kLandmarkCount; ++k) {
      EXPECT_EQ(one.hands[i].joints[k].position, three.hands[i].joints[k].position);
      EXPECT_EQ(one.hands[i].joints[k].covariance, three.hands[i].joints[k].covariance);
    }
    const Image<float>&odds = one.hands[i].labels.hand_log_odds, &other = three.hands[i].labels.hand_log_odds;
    EXPECT_TRUE(std::equal(odds.data(), odds.data() + odds.size(), other.data(), other.data() + other.size()));
  }
}

}  // namespace
}  // namespace barehand
