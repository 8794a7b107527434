#include "stages/pose_prior/hidden_fingers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hand/articulated_pose.h"
#include "math/angles.h"
#include "stages/search/start_templates.h"
#include "support/adult_hand.h"

namespace barehand {
namespace {

constexpr double kWidening = 10 * kDegree;
constexpr double kAtOnce = 0;  // s, no time for the pose to relax
constexpr int kThumb = 0, kIndex = 1, kMiddle = 2, kRing = 3, kLittle = 4;

class HiddenFingersTest : public testing::TestWithParam<Handedness> {
 protected:
  void SetUp() override {
    profile_ = *test::adult_hand(GetParam());
    limits_ = widened_limits(profile_, kWidening);
    seen_.fill(true);
  }
  static void hide(std::array<bool, kSegmentCount>& seen, int finger, int from = 0) {
    for (int k = from; k < 3; ++k) seen[segment_of(finger, k)] = false;
  }
  HandPose following(const HandPose& before, const HandPose& now, double dt) {
    std::array<double, kSegmentCount> shown;
    for (int s = 0; s < kSegmentCount; ++s) shown[s] = seen_[s] ? 1.0 : 0.0;
    return fingers_.follow(profile_, before, now, dt, seen_, shown, holds_, kWidening);
  }
  /// A pose with the given flexion of all fingers, from root to tip, and of the thumb [degrees].
  HandPose bent(double first, double second, double third, double thumb = 0) const {
    ArticulatedPose pose{{palm_orientation(0.3, 0.2, 0.5), {0.02, -0.01, 0.5}}, {}};
    for (int finger = kIndex; finger < kFingerCount; ++finger) {
      const double degrees[] = {first, second, third};
      for (int k = 0; k < 3; ++k) pose.angles[segment_of(finger, k)].flexion = degrees[k] * kDegree;
    }
    for (int k = 1; k < 3; ++k) pose.angles[segment_of(kThumb, k)].flexion = thumb * kDegree;
    return posed(profile_, pose);
  }
  double flexion(const HandPose& pose, int finger, int k) const {
    return joint_angles(profile_, pose, segment_of(finger, k)).flexion / kDegree;
  }
  double abduction(const HandPose& pose, int finger) const {
    return joint_angles(profile_, pose, segment_of(finger, 0)).abduction / kDegree;
  }
  /// `pose` with the finger turned sideways at its root to an abduction [degrees].
  HandPose abducted(const HandPose& pose, int finger, double degrees) const {
    const int root = segment_of(finger, 0);
    HandPose other = pose;
    JointAngles angles = joint_angles(profile_, pose, root);
    angles.abduction = degrees * kDegree;
    other[root].R = pose[kPalm].R * profile_.rest_relative(root).R * joint_rotation(angles);
    for (int s = root + 1; s < root + 3; ++s) other[s] = other[parent_of(s)] * (pose[parent_of(s)].inverse() * pose[s]);
    return other;
  }
  /// Lets the hidden fingers follow for some seconds, while all else rests.
  HandPose rested(HandPose pose, double seconds) {
    for (int i = 0; i < 30; ++i) pose = following(pose, pose, seconds / 30);
    return pose;
  }

  HandProfile profile_;
  std::array<JointLimits, kSegmentCount> limits_{};
  std::array<bool, kSegmentCount> seen_{};
  std::array<FingerHold, kFingerCount> holds_;
  HiddenFingers fingers_;
};

TEST_P(HiddenFingersTest, AreAtEaseLikeTheirNeighbours) {
  const HandPose found = with_finger_of(bent(40, 50, 30), bent(0, 0, 60), kLittle);
  hide(seen_, kLittle);
  hide(seen_, kIndex, 2);
  const HandPose eased = with_hidden_neutral(profile_, found, seen_);
  EXPECT_NEAR(flexion(eased, kLittle, 0), 40, 1e-6);
  EXPECT_NEAR(flexion(eased, kLittle, 1), 40, 1e-6);
  EXPECT_NEAR(flexion(eased, kLittle, 2), 40 * 2.0 / 3, 1e-6);
  EXPECT_NEAR(flexion(eased, kIndex, 1), 50, 1e-6);
  EXPECT_NEAR(flexion(eased, kIndex, 2), 50 * 2.0 / 3, 1e-6);
  for (const int finger : {kMiddle, kRing})
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(flexion(eased, finger, k), flexion(found, finger, k), 1e-9);
}

TEST_P(HiddenFingersTest, FollowWhatTheirNeighboursAreSeenToBend) {
  const HandPose before = bent(20, 30, 10);
  HandPose now = bent(28, 42, 16);
  now = with_finger_of(now, bent(22, 30, 10), kMiddle);
  for (const int finger : {kIndex, kLittle})
    now = with_finger_of(now, before, finger);  // kept where they were last seen
  hide(seen_, kLittle);
  hide(seen_, kIndex, 1);
  const HandPose followed = following(before, now, kAtOnce);
  EXPECT_NEAR(flexion(followed, kLittle, 0), 28, 1e-6);  // the ring finger is next to it
  EXPECT_NEAR(flexion(followed, kLittle, 1), 42, 1e-6);
  EXPECT_NEAR(flexion(followed, kLittle, 2), 16, 1e-6);
  EXPECT_NEAR(flexion(followed, kIndex, 1), 30, 1e-6);  // the middle finger, which stayed
  for (int s = 1; s < kSegmentCount; ++s) {
    if (seen_[s]) {
      EXPECT_LT(boxminus(followed[s], now[s]).norm(), 1e-12) << kSegmentNames[s];
    }
    EXPECT_LT((joint_in_parent(profile_, followed, s) - followed[s].t).norm(), 1e-9) << kSegmentNames[s];
  }
}

TEST_P(HiddenFingersTest, BetweenTwoThatAreSeenFollowBoth) {
  const HandPose before = bent(20, 30, 10);
  HandPose now = with_finger_of(bent(30, 30, 10), bent(26, 30, 10), kLittle);
  now = with_finger_of(now, before, kRing);
  hide(seen_, kRing);
  EXPECT_NEAR(flexion(following(before, now, kAtOnce), kRing, 0), 28, 1e-6);
}

TEST_P(HiddenFingersTest, ComeToBeBentLikeTheirNeighbours) {
  HandPose pose = with_finger_of(bent(20, 30, 10), bent(60, 0, 40), kLittle);
  hide(seen_, kLittle);
  pose = rested(pose, 1.5);
  EXPECT_NEAR(flexion(pose, kLittle, 0), 20 + 40 * std::exp(-1), 1e-6);
  EXPECT_NEAR(flexion(pose, kLittle, 1), 30 - 30 * std::exp(-1), 1e-6);
  EXPECT_NEAR(flexion(pose, kLittle, 2), 10 + 30 * std::exp(-1), 1e-6);
  EXPECT_NEAR(flexion(pose, kRing, 0), 20, 1e-6);
  pose = rested(pose, 30);
  EXPECT_NEAR(flexion(pose, kLittle, 0), 20, 1e-3);
  EXPECT_NEAR(flexion(pose, kLittle, 1), 30, 1e-3);
}

TEST_P(HiddenFingersTest, StayAsTheyWereWhereNoneIsSeen) {
  HandPose pose = with_finger_of(bent(20, 30, 10), bent(60, 0, 40), kLittle);
  seen_.fill(false);
  const HandPose later = following(pose, pose, 60);
  for (int s = 1; s < kSegmentCount; ++s) EXPECT_LT(boxminus(later[s], pose[s]).norm(), 1e-9) << kSegmentNames[s];
}

TEST_P(HiddenFingersTest, StayWithinTheirLimits) {
  const double most = limits_[segment_of(kLittle, 1)].flexion_hi / kDegree;
  const HandPose before = bent(20, most - 8, 10);
  const HandPose now = with_finger_of(bent(20, most, 10), before, kLittle);
  hide(seen_, kLittle);
  const auto aside = [&](double step) {
    HandPose further = now;
    for (const int finger : {kIndex, kMiddle, kRing})
      further = with_finger_of(further, bent(20, most - 8 + step, 10), finger);
    return flexion(following(before, further, kAtOnce), kLittle, 1);
  };
  EXPECT_NEAR(aside(5), most - 3, 1e-6);
  EXPECT_NEAR(aside(20), most, 1e-6);
}

TEST_P(HiddenFingersTest, LeaveTheThumbWhereItIs) {
  const HandPose before = bent(20, 30, 10, 0), now = bent(30, 40, 20, 25);
  hide(seen_, kThumb);
  const HandPose followed = following(before, now, kAtOnce);
  for (int s = 1; s < kSegmentCount; ++s) EXPECT_LT(boxminus(followed[s], now[s]).norm(), 1e-9) << kSegmentNames[s];
}

TEST_P(HiddenFingersTest, CloseWithTheThumbWhereNoneIsSeen) {
  const HandPose before = bent(20, 30, 10, 0),
                 now = bent(20, 30, 10, 10);  // two joints of the thumb, each bent by 10 degrees
  for (int finger = kIndex; finger < kFingerCount; ++finger) hide(seen_, finger);
  const HandPose closed = following(before, now, kAtOnce);
  for (int finger = kIndex; finger < kFingerCount; ++finger) {
    EXPECT_NEAR(flexion(closed, finger, 0), 30, 1e-6);
    EXPECT_NEAR(flexion(closed, finger, 1), 40, 1e-6);
    EXPECT_NEAR(flexion(closed, finger, 2), 15, 1e-6);
  }
}

TEST_P(HiddenFingersTest, DoNotMoveWithTheThumbWhereAFingerOrNoThumbIsSeen) {
  const HandPose before = bent(20, 30, 10, 0), now = bent(20, 30, 10, 10);
  const auto stays = [&] {
    const HandPose followed = following(before, now, kAtOnce);
    for (int s = 1; s < kSegmentCount; ++s) EXPECT_LT(boxminus(followed[s], now[s]).norm(), 1e-9) << kSegmentNames[s];
  };
  for (int finger = kIndex; finger < kFingerCount; ++finger) hide(seen_, finger);
  seen_[segment_of(kLittle, 0)] = true;
  stays();
  seen_[segment_of(kLittle, 0)] = false;
  seen_[segment_of(kThumb, 2)] = false;
  stays();
}

TEST_P(HiddenFingersTest, StayWhereTheyRestOnAnObject) {
  const HandPose before = bent(20, 30, 10), closing = bent(40, 50, 30);
  HandPose now = with_finger_of(closing, before, kRing);
  now = with_finger_of(now, before, kLittle);
  hide(seen_, kRing);
  hide(seen_, kLittle);
  holds_[kLittle].rests = 0.9;
  const HandPose moved = following(before, now, kAtOnce);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(flexion(moved, kRing, k), flexion(closing, kRing, k), 1e-6);
    EXPECT_NEAR(flexion(moved, kLittle, k), flexion(before, kLittle, k), 1e-6);
  }
}

TEST_P(HiddenFingersTest, CloseWithTheThumbBesideASliverOfAFinger) {
  const HandPose before = bent(20, 30, 10, 0), now = bent(20, 30, 10, 10);
  for (int finger = kIndex; finger < kFingerCount; ++finger) hide(seen_, finger);
  seen_[segment_of(kLittle, 0)] = true;
  const auto middle_joint = [&](double shown_of_a_knuckle) {
    std::array<double, kSegmentCount> shown{};
    for (int k = 0; k < 3; ++k) shown[segment_of(kThumb, k)] = 1;
    shown[segment_of(kLittle, 0)] = shown_of_a_knuckle;
    return flexion(fingers_.follow(profile_, before, now, kAtOnce, seen_, shown, holds_, kWidening), kRing, 1);
  };
  EXPECT_NEAR(middle_joint(0.2), 40, 1e-6);
  EXPECT_NEAR(middle_joint(0.5), 30, 1e-6);
}

TEST_P(HiddenFingersTest, CloseOnWhatTheHandGrips) {
  const HandPose before = bent(20, 30, 10), opening = bent(10, 20, 0);
  HandPose now = with_finger_of(opening, before, kLittle);
  hide(seen_, kLittle);
  holds_[kLittle].closed = {50 * kDegree, 40 * kDegree, 30 * kDegree};
  holds_[kRing].closed = {50 * kDegree, 40 * kDegree, 30 * kDegree};  // it is seen, so that this must not matter
  const HandPose at_once = following(before, now, kAtOnce);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(flexion(at_once, kLittle, k), flexion(before, kLittle, k), 1e-6);

  const HandPose later = rested(now, 2);
  EXPECT_NEAR(flexion(later, kLittle, 0), 50, 0.01);
  EXPECT_NEAR(flexion(later, kLittle, 1), 40, 0.01);
  EXPECT_NEAR(flexion(later, kLittle, 2), 30, 0.01);
  EXPECT_NEAR(flexion(later, kRing, 0), 10, 1e-6);
  for (int s = 1; s < kSegmentCount; ++s)
    EXPECT_LT((joint_in_parent(profile_, later, s) - later[s].t).norm(), 1e-9) << kSegmentNames[s];
}

TEST_P(HiddenFingersTest, OpenWithTheirNeighboursAtOnceAfterARelease) {
  const HandPose gripped = bent(50, 50, 30);
  hide(seen_, kLittle);
  const auto after_opening = [&](double held) {
    fingers_.forget();
    holds_[kLittle].rests = held;
    HandPose pose = following(gripped, gripped, 0.03);

    // The fingers that are seen open, and only then this shows that the hand grips no more.
    const HandPose open = with_finger_of(bent(20, 20, 10), gripped, kLittle);
    pose = following(pose, open, 0.03);
    holds_[kLittle].rests = 0;
    return flexion(rested(pose, 0.3), kLittle, 0);
  };
  EXPECT_NEAR(after_opening(1), 20, 4);
  EXPECT_NEAR(after_opening(0), 20, 1) << "a finger that was not held opened with the others";

  // A difference that no release explains decays slowly.
  fingers_.forget();
  EXPECT_GT(flexion(rested(with_finger_of(bent(20, 20, 10), gripped, kLittle), 0.3), kLittle, 0), 40);
}

TEST_P(HiddenFingersTest, ReturnToTheAbductionThatWasSeen) {
  HandPose pose = abducted(bent(20, 30, 10), kRing, 8);
  rested(pose, 2);
  hide(seen_, kRing);
  pose = rested(abducted(pose, kRing, -6), 3);
  EXPECT_NEAR(abduction(pose, kRing), 8, 0.1);
  EXPECT_NEAR(flexion(pose, kRing, 0), 20, 1e-6);

  // What was never seen of this hand is left alone.
  fingers_.forget();
  pose = rested(abducted(pose, kRing, -6), 3);
  EXPECT_NEAR(abduction(pose, kRing), -6, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(BothHands, HiddenFingersTest, testing::Values(Handedness::right, Handedness::left),
                         [](const auto& info) { return std::string(to_string(info.param)); });

}  // namespace
}  // namespace barehand
