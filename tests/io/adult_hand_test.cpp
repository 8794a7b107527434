#include <gtest/gtest.h>

#include "hand/joint_angles.h"
#include "io/hand/hand_json.h"

namespace barehand {
namespace {

class AdultHand : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const auto loaded = load_profile(std::string(BAREHAND_CONFIGS) + "/hands/" + GetParam());
    ASSERT_TRUE(loaded) << loaded.error().message();
    hand_ = *loaded;
    rest_ = forward_kinematics(hand_, {}, {});
    side_ = hand_.handedness == Handedness::right ? 1 : -1;
  }
  Eigen::Vector3d tip(int finger) const { return distal_end(hand_, rest_, segment_of(finger, 2)); }

  HandProfile hand_;
  HandPose rest_;
  double side_ = 0;  ///< +1: the little finger is on the side of +x
};

TEST_P(AdultHand, HasTheSizeOfAnAdult) {
  // The length of a hand is measured from the crease of the wrist, which lies over the head of the capitate bone, 16 mm
  // distal to the wrist joint.
  const double from_crease = hand_.hand_length() - 0.016;
  EXPECT_GT(from_crease, 0.166);
  EXPECT_LT(from_crease, 0.183);
  const double knuckles = (rest_[segment_of(1, 0)].t - rest_[segment_of(4, 0)].t).norm();
  const double breadth = knuckles + 0.010 + hand_.segments[segment_of(1, 0)].radius[0] +
                         hand_.segments[segment_of(4, 0)].radius[0];  // 5 mm of soft tissue on both sides
  EXPECT_GT(breadth, 0.075);
  EXPECT_LT(breadth, 0.086);
}

TEST_P(AdultHand, SegmentsMeetAtTheirJoints) {
  for (int s = 1; s < kSegmentCount; ++s) {
    const bool on_bone = (s - 1) % 3 != 0 || s == segment_of(2, 0);  // of the palm's children only the middle finger's
    if (on_bone) {
      EXPECT_LT((distal_end(hand_, rest_, parent_of(s)) - rest_[s].t).norm(), 2e-6) << kSegmentNames[s];
    }
  }
}

TEST_P(AdultHand, MiddleFingerIsLongestAndThumbShortest) {
  const auto length = [this](int finger) {
    return (rest_[segment_of(finger, 0)].t - tip(finger)).norm() + hand_.segments[segment_of(finger, 2)].radius[1];
  };
  EXPECT_GT(length(2), length(3));
  EXPECT_GT(length(3), length(1));
  EXPECT_GT(length(1), length(4));
  EXPECT_GT(-tip(1).z(), -tip(4).z());
  EXPECT_GT(-tip(4).z(), -tip(0).z());
}

TEST_P(AdultHand, FingersFanOutFromThumbToLittle) {
  for (int finger = 1; finger < kFingerCount; ++finger) {
    EXPECT_GT(side_ * (tip(finger) - tip(finger - 1)).x(), 0.01) << "finger " << finger;
    const double apart = (tip(finger) - tip(finger - 1)).norm();
    EXPECT_GT(apart, hand_.segments[segment_of(finger, 2)].radius[1] * 2);
  }
}

TEST_P(AdultHand, NailsFaceBackwardsAndTheThumbsSideways) {
  for (int finger = 1; finger < kFingerCount; ++finger) EXPECT_GT(rest_[segment_of(finger, 2)].R.col(1).y(), 0.95);
  EXPECT_LT(side_ * rest_[segment_of(0, 2)].R.col(1).x(), -0.7);
}

TEST_P(AdultHand, FlexedThumbCrossesThePalmAndFlexedFingersReachIt) {
  std::array<JointAngles, kSegmentCount> angles{};
  for (int s = 1; s < kSegmentCount; ++s)
    angles[s].flexion = widened_limits(hand_, 0)[s].flexion_hi * (finger_of(s) == 0 ? 1 : 0.9);
  const HandPose fist = forward_kinematics(hand_, {}, angles);
  EXPECT_GT(side_ * distal_end(hand_, fist, segment_of(0, 2)).x(), side_ * tip(0).x() + 0.03);
  for (int finger = 1; finger < kFingerCount; ++finger) {
    const Eigen::Vector3d p = distal_end(hand_, fist, segment_of(finger, 2));
    EXPECT_LT(p.y(), -0.005) << "palmar of the palm's middle";
    EXPECT_GT(p.z(), -0.085) << "not beyond the knuckles";
  }
}

TEST_P(AdultHand, FingersTaperAndAbductionTurnsAwayFromTheMiddleFinger) {
  for (int s = 1; s < kSegmentCount; ++s) {
    EXPECT_GE(hand_.segments[s].radius[0], hand_.segments[s].radius[1]) << kSegmentNames[s];
    EXPECT_GE(hand_.segments[s].radius[1], 0.0042);
  }
  for (int finger : {1, 3, 4}) {
    const SegmentProfile& knuckle = hand_.segments[segment_of(finger, 0)];
    const Eigen::Vector3d turned = knuckle.T_hand_segment.R * exp_so3(0.2 * knuckle.dofs[0].axis) * knuckle.distal;
    const double outwards = side_ * (turned - knuckle.T_hand_segment.R * knuckle.distal).x();
    EXPECT_GT(finger == 1 ? -outwards : outwards, 0.005) << "finger " << finger;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, AdultHand, testing::Values("adult_right.json", "adult_left.json"),
                         [](const auto& info) {
                           return std::string(info.param).substr(6, 1) == "r" ? "Right" : "Left";
                         });

TEST(AdultHands, LeftIsTheMirrorImageOfRight) {
  const auto right = load_profile(std::string(BAREHAND_CONFIGS) + "/hands/adult_right.json");
  const auto left = load_profile(std::string(BAREHAND_CONFIGS) + "/hands/adult_left.json");
  ASSERT_TRUE(right && left);
  const HandProfile mirror = mirrored(*right);
  EXPECT_EQ(mirror.handedness, left->handedness);
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentProfile &a = mirror.segments[s], &b = left->segments[s];
    EXPECT_TRUE(a.T_hand_segment.matrix().isApprox(b.T_hand_segment.matrix(), 1e-8)) << kSegmentNames[s];
    EXPECT_TRUE(a.distal.isApprox(b.distal));
    EXPECT_EQ(a.flesh_offset_x, b.flesh_offset_x);
    ASSERT_EQ(a.dofs.size(), b.dofs.size());
    for (std::size_t d = 0; d < a.dofs.size(); ++d) EXPECT_TRUE(a.dofs[d].axis.isApprox(b.dofs[d].axis));
  }
}

}  // namespace
}  // namespace barehand
