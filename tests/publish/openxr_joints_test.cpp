#include "stages/publish/openxr_joints.h"

#include "published_hand.h"

namespace barehand {
namespace {

constexpr int kXrPalm = 0, kXrWrist = 1, kXrThumbMetacarpal = 2, kXrIndexMetacarpal = 6;
constexpr int xr_metacarpal(int finger) { return kXrIndexMetacarpal + 5 * (finger - 1); }

class OpenXr : public testing::TestWithParam<Handedness> {
 protected:
  HandProfile profile_ = *test::adult_hand(GetParam());
  HandPose pose_ = [this] {
    Angles angles{};
    for (int s = 1; s < kSegmentCount; ++s) angles[s].flexion = 3 * s * kDegree;
    return forward_kinematics(profile_, somewhere(), angles);
  }();
  std::array<OpenXrJoint, kOpenXrJointCount> joints_ = openxr_joints(profile_, pose_);
};

TEST_P(OpenXr, SegmentsStandInTheOrderOfTheSpecification) {
  EXPECT_EQ(joints_[kXrWrist].T_camera_joint.matrix(), pose_[kPalm].matrix());
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(joints_[kXrThumbMetacarpal + k].T_camera_joint.matrix(), pose_[segment_of(0, k)].matrix());
    for (int finger = 1; finger < kFingerCount; ++finger) {
      const OpenXrJoint& joint = joints_[xr_metacarpal(finger) + 1 + k];
      EXPECT_EQ(joint.T_camera_joint.matrix(), pose_[segment_of(finger, k)].matrix()) << finger << k;
      EXPECT_EQ(joint.segment, segment_of(finger, k));
      EXPECT_EQ(joint.radius, profile_.segments[segment_of(finger, k)].radius[0]);
    }
  }
}

TEST_P(OpenXr, TipsAreTheDistalEndsWithTheirRadii) {
  for (int finger = 0; finger < kFingerCount; ++finger) {
    const int tip = finger == 0 ? 5 : xr_metacarpal(finger) + 4;
    EXPECT_LT((joints_[tip].T_camera_joint.t - distal_end(profile_, pose_, segment_of(finger, 2))).norm(), 1e-12);
    EXPECT_EQ(joints_[tip].radius, profile_.segments[segment_of(finger, 2)].radius[1]);
  }
}

// From each joint, -z leads to the next one of the finger and +y to the dorsal side.
TEST_P(OpenXr, MetacarpalsPointAtTheKnucklesWithTheBackOfTheHandUp) {
  for (int finger = 1; finger < kFingerCount; ++finger) {
    const SE3& joint = joints_[xr_metacarpal(finger)].T_camera_joint;
    const Eigen::Vector3d to_knuckle = pose_[segment_of(finger, 0)].t - joint.t;
    EXPECT_LT((to_knuckle.normalized() + joint.R.col(2)).norm(), 1e-9) << finger;
    EXPECT_GT(joint.R.col(1).dot(pose_[kPalm].R.col(1)), 0.95) << finger;
    EXPECT_NEAR(joint.R.determinant(), 1, 1e-9);
    EXPECT_GT(to_knuckle.norm(), 0.040) << finger;
    EXPECT_LT(to_knuckle.norm(), 0.075) << finger;
  }
}

TEST_P(OpenXr, MetacarpalsMoveWithThePalmOnly) {
  HandPose moved = pose_;
  for (int s = 1; s < kSegmentCount; ++s) moved[s].t.x() += 0.1;
  const auto joints = openxr_joints(profile_, moved);
  for (int finger = 1; finger < kFingerCount; ++finger) {
    EXPECT_EQ(joints[xr_metacarpal(finger)].T_camera_joint.matrix(),
              joints_[xr_metacarpal(finger)].T_camera_joint.matrix());
    EXPECT_EQ(joints[xr_metacarpal(finger)].segment, kPalm);
  }
}

TEST_P(OpenXr, ThePalmJointLiesMidwayAlongTheMiddleMetacarpal) {
  const Eigen::Vector3d middle = (joints_[xr_metacarpal(2)].T_camera_joint.t + pose_[segment_of(2, 0)].t) / 2;
  EXPECT_LT((joints_[kXrPalm].T_camera_joint.t - middle).norm(), 1e-12);
  EXPECT_GT(joints_[kXrPalm].radius, 0.008);
}

INSTANTIATE_TEST_SUITE_P(BothHands, OpenXr, testing::Values(Handedness::right, Handedness::left),
                         [](const auto& info) { return std::string(to_string(info.param)); });

}  // namespace
}  // namespace barehand
