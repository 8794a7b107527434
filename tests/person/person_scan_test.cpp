#include "person/person_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "hand/hand_shape.h"
#include "support/painted_hand.h"

namespace barehand {
namespace {

/// A person with larger and thicker fingers than the mean hand, who turns and bends the hand.
class PersonScanTest : public ::testing::Test {
 protected:
  PersonScanTest() {
    params_.skin_cell = 0.008;  // m, coarse: few unknowns
    params_.shape_fit.scan_after = 60;
    params_.shape_fit.scans = 2;
  }
  static HandShape shape_of_the_person(double fingers_thickness = 0.1) {
    HandShape shape = HandShape::Zero();
    shape[0] = 0.05;
    for (int k = 0; k < kShapeCount; ++k)
      if (shape_parameters()[k].name == "fingers_thickness") shape[k] = fingers_thickness;
    return shape;
  }
  /// Mean distance of a phalanx's skin from its bone [m].
  static double thickness(const Skin& skin, int segment) {
    double sum = 0;
    int count = 0;
    for (const SkinVertex& v : skin.vertices)
      if (v.a == segment && v.weight_b < 0.1f) sum += v.in_a.head<2>().norm(), ++count;
    return sum / count;
  }
  void show(PersonScan& scan, int frames) {
    for (int i = 0; i < frames; ++i, ++shown_) {
      const HandPose facing = test::facing_pose(person_, 0.45, 0.15 + 0.1 * (shown_ % 8));
      const HandPose pose =
          test::turned(facing, {0.4 * std::sin(shown_), 0.5 * std::cos(0.7 * shown_), 0}, facing[kPalm].t);
      scan.add(*test::observe_skin(persons_skin_, pose), pose);
    }
  }
  static std::shared_ptr<const HandProfile> wait_for(PersonScan& scan) {
    for (int i = 0; i < 600000; ++i) {  // takes minutes if a sanitizer slows it down
      if (auto hand = scan.take()) return hand;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return nullptr;
  }

  PersonScanParams params_;
  const std::shared_ptr<const HandProfile> mean_ = test::adult_hand();
  const HandProfile person_ = reshaped(*mean_, shape_of_the_person());
  const Skin persons_skin_ = make_blended_skin(person_, 0.004);
  Workers workers_{2};
  int shown_ = 0;
};

TEST_F(PersonScanTest, ARecordingHasTheHandAtOnce) {
  PersonScan scan(params_, mean_, workers_);
  show(scan, params_.shape_fit.scan_after - 1);
  EXPECT_FALSE(scan.take());
  show(scan, 1);
  const auto hand = scan.take();
  ASSERT_TRUE(hand);
  EXPECT_FALSE(scan.take());
  EXPECT_TRUE(hand->scanned_skin);
  EXPECT_EQ(hand->origin, ProfileOrigin::fitted);
  const double error = std::abs(hand->hand_length() - person_.hand_length());
  EXPECT_LT(error, 0.5 * std::abs(mean_->hand_length() - person_.hand_length()));
}

TEST_F(PersonScanTest, AMeasuredHandKeepsItsJointsAndGetsASkin) {
  // A measured hand with the person's bones.
  auto measured = std::make_shared<HandProfile>(reshaped(*mean_, shape_of_the_person(0)));
  measured->origin = ProfileOrigin::measured;
  PersonScan scan(params_, measured, workers_);
  show(scan, params_.shape_fit.scan_after);

  // The scan keeps the joints ...
  const auto hand = scan.take();
  ASSERT_TRUE(hand && hand->scanned_skin);
  EXPECT_EQ(hand->origin, ProfileOrigin::measured);

  // ... and brings the skin closer to the person's.
  const Skin before = make_blended_skin(*measured, params_.skin_cell);
  double error = 0, error_before = 0;
  for (int s = 1; s < kSegmentCount; ++s) {
    EXPECT_LT((hand->rest_relative(s).t - measured->rest_relative(s).t).norm(), 1e-5) << kSegmentNames[s];
    if (finger_of(s) == 0 || parent_of(s) == kPalm || is_tip(s)) continue;
    const double truth = thickness(persons_skin_, s);
    error += std::abs(thickness(*hand->scanned_skin, s) - truth);
    error_before += std::abs(thickness(before, s) - truth);
  }
  EXPECT_LT(error, 0.5 * error_before);
}

TEST_F(PersonScanTest, ScansAsOftenAsItIsTold) {
  PersonScan scan(params_, mean_, workers_);
  show(scan, params_.shape_fit.scan_after);
  EXPECT_TRUE(scan.take());
  show(scan, params_.shape_fit.scan_after - 1);
  EXPECT_FALSE(scan.take());
  show(scan, 1);
  EXPECT_TRUE(scan.take());
  show(scan, 4 * params_.shape_fit.scan_after);
  EXPECT_FALSE(scan.take());
}

TEST_F(PersonScanTest, AnotherHandIsScannedAfterAsMuchAsTheLastScanSaw) {
  PersonScan scan(params_, mean_, workers_);
  show(scan, 2 * params_.shape_fit.scan_after);
  EXPECT_TRUE(scan.take());
  scan.restart();
  show(scan, 2 * params_.shape_fit.scan_after - 1);
  EXPECT_FALSE(scan.take());
  show(scan, 1);
  EXPECT_TRUE(scan.take());
}

TEST_F(PersonScanTest, ALiveHandIsScannedMeanwhileAndAlike) {
  PersonScan waiting(params_, mean_, workers_);
  show(waiting, params_.shape_fit.scan_after);
  const auto expected = waiting.take();
  Workers live(2);
  live.go_live();
  shown_ = 0;
  PersonScan scan(params_, mean_, live);
  show(scan, params_.shape_fit.scan_after);
  const auto hand = wait_for(scan);
  ASSERT_TRUE(expected && hand);
  for (std::size_t i = 0; i < hand->scanned_skin->vertices.size(); ++i)
    ASSERT_EQ(hand->scanned_skin->vertices[i].in_a, expected->scanned_skin->vertices[i].in_a);
}

TEST_F(PersonScanTest, SaysThatItsHandIsOfTheHandBefore) {
  PersonScan scan(params_, mean_, workers_);
  show(scan, params_.shape_fit.scan_after);
  scan.restart();  // before the scan is taken
  EXPECT_TRUE(scan.take());
  EXPECT_TRUE(scan.of_hand_before());
  show(scan, params_.shape_fit.scan_after << 1);
  EXPECT_TRUE(scan.take());
  EXPECT_FALSE(scan.of_hand_before());
}

}  // namespace
}  // namespace barehand
