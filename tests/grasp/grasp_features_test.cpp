#include "stages/grasp/grasp_features.h"

#include <cmath>

#include "grasp/grasp_hand.h"

namespace barehand {
namespace {

using test::bent;
using test::grasping_hand;

constexpr int kIndexKnuckle = 9, kIndexPip = 11;       // flexions among the features
constexpr int kThumbToIndex = 25, kPalmToMiddle = 37;  // distances
constexpr int kIndexDipAngle = 8;                      // among the angles

Eigen::Vector3d tip(const HandEstimate& estimate, int finger) {
  return distal_end(*estimate.profile, pose_of(estimate.segments), segment_of(finger, 2));
}

TEST(GraspFeatures, AJointThatBendsIsTheFeatureOfThatJoint) {
  const auto flat = grasp_features(grasping_hand(), nullptr).values;
  auto angles = bent(0, 0, 0);
  angles[segment_of(1, 1)].flexion = 0.5;
  const auto bent_index = grasp_features(grasping_hand(angles), nullptr).values;
  for (int feature = kIndexKnuckle; feature < kThumbToIndex; ++feature)
    EXPECT_NEAR(bent_index[feature] - flat[feature], feature == kIndexPip ? 0.5 : 0, 1e-9) << feature;
}

TEST(GraspFeatures, DistancesAreRelativeToTheSizeOfTheHand) {
  const HandEstimate hand = grasping_hand(bent(0.7, 0.8, 0.4));
  const auto values = grasp_features(hand, nullptr).values;
  const double size = hand.segments[segment_of(2, 0)].T_camera_segment.t.norm();  // the wrist is at the origin
  EXPECT_NEAR(values[kThumbToIndex], (tip(hand, 0) - tip(hand, 1)).norm() / size, 1e-12);
  EXPECT_NEAR(values[kPalmToMiddle], (tip(hand, 2) - Eigen::Vector3d(0, -0.2 * size, -0.75 * size)).norm() / size,
              1e-12);
}

TEST(GraspFeatures, DependNeitherOnPlaceNorOnSizeNorOnTheSide) {
  auto angles = bent(0.7, 0.8, 0.4);
  angles[segment_of(0, 0)] = {0.4, 0.3, 0};
  angles[segment_of(1, 0)].abduction = 0.2;
  const auto values = grasp_features(grasping_hand(angles), nullptr).values;
  const SE3 elsewhere{exp_so3({0.4, -0.9, 2.0}), {0.05, -0.1, 0.5}};
  EXPECT_TRUE(
      grasp_features(grasping_hand(angles, Handedness::right, elsewhere), nullptr).values.isApprox(values, 1e-9));
  EXPECT_TRUE(grasp_features(grasping_hand(angles, Handedness::right, {}, 1.2), nullptr).values.isApprox(values, 1e-9));

  // A left hand bends as the mirror image does: about y and z the other way round.
  for (JointAngles& joint : angles) joint.abduction *= -1;
  EXPECT_TRUE(grasp_features(grasping_hand(angles, Handedness::left), nullptr).values.isApprox(values, 1e-6));
}

TEST(GraspFeatures, AJointIsAsUncertainAsItsSegmentIsMoreThanThatOneBefore) {
  HandEstimate hand = grasping_hand(bent(0.3, 0.3, 0.3));
  hand.segments[segment_of(1, 2)].covariance = 0.01 * Matrix6d::Identity();
  const GraspFeatures features = grasp_features(hand, nullptr);
  for (int angle = 0; angle < kGraspAngleCount; ++angle)
    EXPECT_NEAR(features.deviations[angle], angle == kIndexDipAngle ? 0.1 : 0, 1e-9) << angle;
}

TEST(GraspFeatures, AnErrorOfThePalmThatTheFingersShareIsNone) {
  HandEstimate hand = grasping_hand();
  for (SegmentState& segment : hand.segments) segment.covariance = 0.04 * Matrix6d::Identity();
  EXPECT_EQ(grasp_features(hand, nullptr).deviations.norm(), 0);
}

TEST(GraspFeatures, AFingerTouchesIfOneOfItsSegmentsDoes) {
  SegmentContacts objects;
  objects[kPalm].state = ContactState::near;
  objects[segment_of(0, 0)].state = ContactState::touching;  // the ball of the thumb is not the thumb
  objects[segment_of(1, 0)].state = ContactState::none;
  objects[segment_of(1, 2)].state = ContactState::touching;
  objects[segment_of(4, 1)].state = ContactState::none;
  const HandEstimate hand = grasping_hand();
  const auto touches = grasp_features(hand, &objects).touches;
  ASSERT_TRUE(touches);
  using enum PartTouch;
  EXPECT_EQ(*touches, (std::array{apart, unknown, touching, unknown, unknown, apart}));
  EXPECT_FALSE(grasp_features(hand, nullptr).touches) << "nobody looked";
}

TEST(GraspOpening, IsFromTheThumbToTheFingersThatOpposeIt) {
  const HandEstimate hand = grasping_hand(bent(0.5, 0.5, 0.5));
  EXPECT_NEAR(grasp_opening(hand, 2, 2).aperture, (tip(hand, 0) - tip(hand, 1)).norm(), 1e-12);
  EXPECT_NEAR(grasp_opening(hand, 2, 3).aperture, (tip(hand, 0) - (tip(hand, 1) + tip(hand, 2)) / 2).norm(), 1e-12);
}

TEST(GraspOpening, AFlatHandIsOpenAndAFistClosed) {
  EXPECT_LT(grasp_opening(grasping_hand(), 2, 2).closure, 0.05);
  EXPECT_NEAR(grasp_opening(grasping_hand(bent(0.8, 0.9, 0.5)), 2, 2).closure, 2.2 / 4.974, 0.05);
  EXPECT_GT(grasp_opening(grasping_hand(bent(1.4, 1.8, 1.2)), 2, 2).closure, 0.85);
}

}  // namespace
}  // namespace barehand
