#include "stages/pose_prior/crossed_fingers.h"

#include <gtest/gtest.h>

#include "math/angles.h"
#include "stages/search/start_templates.h"
#include "support/point_world.h"

namespace barehand {
namespace {

constexpr double kWidening = 10 * kDegree;

class CrossedFingers : public testing::TestWithParam<Handedness> {
 protected:
  void SetUp() override {
    profile_ = *test::adult_hand(GetParam());
    limits_ = widened_limits(profile_, kWidening);
    pose_.T_camera_palm = {palm_orientation(0.3, 0.2, 0.5), {0.02, -0.01, 0.5}};
    for (int finger = 1; finger < kFingerCount; ++finger)
      for (int k = 0; k < 3; ++k) pose_.angles[segment_of(finger, k)].flexion = 10 * kDegree;
  }
  /// Abducts a finger; positive angles move it towards the thumb, on either hand.
  void abduct(int finger, double degrees) {
    pose_.angles[segment_of(finger, 0)].abduction = side_sign(profile_.handedness) * degrees * kDegree;
  }
  Eigen::Vector3d tip(const HandPose& pose, int finger) const {
    return distal_end(profile_, pose, segment_of(finger, 2));
  }

  HandProfile profile_;
  std::array<JointLimits, kSegmentCount> limits_{};
  ArticulatedPose pose_;
};

TEST_P(CrossedFingers, ChangePlaces) {
  abduct(2, -20);
  abduct(3, 20);
  pose_.angles[segment_of(2, 1)].flexion = 25 * kDegree;
  const HandPose crossed = posed(profile_, pose_);
  const auto apart = uncrossed(profile_, crossed, kWidening);
  ASSERT_TRUE(apart);
  EXPECT_FALSE(uncrossed(profile_, *apart, kWidening));
  const double between = (tip(crossed, 2) - tip(crossed, 3)).norm();
  EXPECT_GT(between, 0.03);
  // The fingertips do not swap exactly, since the fingers differ in length.
  EXPECT_LT((tip(*apart, 2) - tip(crossed, 3)).norm(), between / 2);
  EXPECT_LT((tip(*apart, 3) - tip(crossed, 2)).norm(), between / 2);
  for (const int finger : {0, 1, 4}) EXPECT_LT((tip(*apart, finger) - tip(crossed, finger)).norm(), 1e-9);
}

TEST_P(CrossedFingers, AreNotSeenWhereFingersTouchOrCurl) {
  for (const ShapeTemplate& shape : shape_templates(profile_, limits_)) {
    pose_.angles = shape.angles;
    EXPECT_FALSE(uncrossed(profile_, posed(profile_, pose_), kWidening)) << shape.name;
  }
  pose_.angles = {};
  for (int k = 0; k < 3; ++k) pose_.angles[segment_of(2, k)].flexion = 80 * kDegree;
  EXPECT_FALSE(uncrossed(profile_, posed(profile_, pose_), kWidening)) << "middle finger curled, the others stretched";
}

INSTANTIATE_TEST_SUITE_P(BothHands, CrossedFingers, testing::Values(Handedness::right, Handedness::left),
                         [](const auto& info) { return std::string(to_string(info.param)); });

}  // namespace
}  // namespace barehand
