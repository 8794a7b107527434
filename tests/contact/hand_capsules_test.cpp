#include "stages/contact/hand_capsules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/angles.h"
#include "support/adult_hand.h"

namespace barehand {
namespace {

/// The smallest distance of two segments [m]; NaN, which no comparison accepts, if they are not compared.
double distance(const HandCapsules& capsules, const HandPose& pose, int a, int b) {
  double least = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [i, j] : capsules.apart()) {
    const HandCapsules::Capsule &first = capsules.capsules()[i], &second = capsules.capsules()[j];
    if (std::minmax(first.segment, second.segment) == std::minmax(a, b))
      least = std::fmin(least, HandCapsules::distance(first, pose, second, pose).distance);
  }
  return least;
}

TEST(HandCapsules, FingertipsOfASpreadHandAreApart) {
  const auto profile = test::adult_hand();
  const HandCapsules capsules(*profile);
  const HandPose pose = test::facing_pose(*profile, 0.5, 0);
  EXPECT_GT(distance(capsules, pose, segment_of(0, 2), segment_of(1, 2)), 0.04);
  EXPECT_GT(distance(capsules, pose, segment_of(2, 2), kPalm), 0.04);
}

TEST(HandCapsules, FingersOfAFistTouchThePalm) {
  const auto profile = test::adult_hand();
  const HandCapsules capsules(*profile);
  std::array<JointAngles, kSegmentCount> angles{};
  for (int k = 0; k < 3; ++k) angles[segment_of(2, k)].flexion = std::array{75, 100, 60}[k] * kDegree;
  const HandPose pose = forward_kinematics(*profile, {Eigen::Matrix3d::Identity(), {0, 0, 0.5}}, angles);
  EXPECT_LT(distance(capsules, pose, segment_of(2, 2), kPalm), 0.01);
}

TEST(HandCapsules, DistanceOfParallelRodsIsThatOfTheirSkins) {
  const HandCapsules::Capsule capsule{1, {Eigen::Vector3d::Zero(), {0, 0, -0.03}}, {0.008, 0.006}, {0.010, 0.010}};
  HandPose a, b;
  for (const double gap : {0.005, -0.002}) {
    b[1].t.x() = 0.014 + gap;  // the mean half width of each is 7 mm
    const CapsuleDistance measured = HandCapsules::distance(capsule, a, capsule, b);
    EXPECT_NEAR(measured.distance, gap, 0.0021);
    EXPECT_LT(measured.normal.x(), -0.99) << "from b to a";
    b[1].t.x() = 0;
  }
  b[1].t.y() = 0.03;
  EXPECT_NEAR(HandCapsules::distance(capsule, a, capsule, b).distance, 0.01, 1e-9) << "across the half thickness";
}

TEST(HandCapsules, SegmentsOfOneFingerAreNotCompared) {
  const auto profile = test::adult_hand();
  const HandCapsules capsules(*profile);
  for (const auto& [i, j] : capsules.apart()) {
    const int a = capsules.capsules()[i].segment, b = capsules.capsules()[j].segment;
    EXPECT_TRUE(a == kPalm || b == kPalm || finger_of(a) != finger_of(b));
  }
}

}  // namespace
}  // namespace barehand
