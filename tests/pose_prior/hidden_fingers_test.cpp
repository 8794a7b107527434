#include "stages/pose_prior/hidden_fingers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/angles.h"
#include "stages/search/start_templates.h"
#include "support/adult_hand.h"

namespace barehand {
namespace {

constexpr double kWidening = 10 * kDegree;
constexpr double kAtOnce = 0;  // s, no time for the pose to relax
constexpr int kThumb = 0, kIndex = 1, kMiddle = 2, kRing = 3, kLittle = 4;

class HiddenFingers : public testing::TestWithParam<Handedness> {
 protected:
  void SetUp() override {
    profile_ = *test::adult_hand(GetParam());
    limits_ = widened_limits(profile_, kWidening);
    seen_.fill(true);
  }
  static void hide(std::array<bool, kSegmentCount>& seen, int finger, int from = 0) {
    for (int k = from; k < 3; ++k) seen[segment_of(finger, k)] = false;
  }
  HandPose following(const HandPose& before, const HandPose& now, double dt) const {
    std::array<double, kSegmentCount> shown;
    for (int s = 0; s < kSegmentCount; ++s) shown[s] = seen_[s] ? 1.0 : 0.0;
    return with_hidden_following(profile_, before, now, dt, seen_, shown, stay_, kWidening);
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
  /// `pose` with one finger taken from the pose `other`, relative to the palm.
  static HandPose with_finger_of(const HandPose& pose, const HandPose& other, int finger) {
    HandPose result = pose;
    for (int k = 0; k < 3; ++k) {
      const int s = segment_of(finger, k);
      result[s] = pose[kPalm] * (other[kPalm].inverse() * other[s]);
    }
    return result;
  }

  HandProfile profile_;
  std::array<JointLimits, kSegmentCount> limits_{};
  std::array<bool, kSegmentCount> seen_{};
  std::array<bool, kFingerCount> stay_{};
};

TEST_P(HiddenFingers, AreAtEaseLikeTheirNeighbours) {
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

TEST_P(HiddenFingers, FollowWhatTheirNeighboursAreSeenToBend) {
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

TEST_P(HiddenFingers, BetweenTwoThatAreSeenFollowBoth) {
  const HandPose before = bent(20, 30, 10);
  HandPose now = with_finger_of(bent(30, 30, 10), bent(26, 30, 10), kLittle);
  now = with_finger_of(now, before, kRing);
  hide(seen_, kRing);
  EXPECT_NEAR(flexion(following(before, now, kAtOnce), kRing, 0), 28, 1e-6);
}

TEST_P(HiddenFingers, ComeToBeBentLikeTheirNeighbours) {
  HandPose pose = with_finger_of(bent(20, 30, 10), bent(60, 0, 40), kLittle);
  hide(seen_, kLittle);
  const auto wait = [&](double seconds) {
    for (int i = 0; i < 30; ++i) pose = following(pose, pose, seconds / 30);
  };
  wait(1.5);
  EXPECT_NEAR(flexion(pose, kLittle, 0), 20 + 40 * std::exp(-1), 1e-6);
  EXPECT_NEAR(flexion(pose, kLittle, 1), 30 - 30 * std::exp(-1), 1e-6);
  EXPECT_NEAR(flexion(pose, kLittle, 2), 10 + 30 * std::exp(-1), 1e-6);
  EXPECT_NEAR(flexion(pose, kRing, 0), 20, 1e-6);
  wait(30);
  EXPECT_NEAR(flexion(pose, kLittle, 0), 20, 1e-3);
  EXPECT_NEAR(flexion(pose, kLittle, 1), 30, 1e-3);
}

TEST_P(HiddenFingers, StayAsTheyWereWhereNoneIsSeen) {
  HandPose pose = with_finger_of(bent(20, 30, 10), bent(60, 0, 40), kLittle);
  seen_.fill(false);
  const HandPose later = following(pose, pose, 60);
  for (int s = 1; s < kSegmentCount; ++s) EXPECT_LT(boxminus(later[s], pose[s]).norm(), 1e-9) << kSegmentNames[s];
}

TEST_P(HiddenFingers, StayWithinTheirLimits) {
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

TEST_P(HiddenFingers, LeaveTheThumbWhereItIs) {
  const HandPose before = bent(20, 30, 10, 0), now = bent(30, 40, 20, 25);
  hide(seen_, kThumb);
  const HandPose followed = following(before, now, kAtOnce);
  for (int s = 1; s < kSegmentCount; ++s) EXPECT_LT(boxminus(followed[s], now[s]).norm(), 1e-9) << kSegmentNames[s];
}

TEST_P(HiddenFingers, CloseWithTheThumbWhereNoneIsSeen) {
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

TEST_P(HiddenFingers, DoNotMoveWithTheThumbWhereAFingerOrNoThumbIsSeen) {
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

TEST_P(HiddenFingers, StayWhereTheyRestOnAnObject) {
  const HandPose before = bent(20, 30, 10), closing = bent(40, 50, 30);
  HandPose now = with_finger_of(closing, before, kRing);
  now = with_finger_of(now, before, kLittle);
  hide(seen_, kRing);
  hide(seen_, kLittle);
  stay_[kLittle] = true;
  const HandPose moved = following(before, now, kAtOnce);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(flexion(moved, kRing, k), flexion(closing, kRing, k), 1e-6);
    EXPECT_NEAR(flexion(moved, kLittle, k), flexion(before, kLittle, k), 1e-6);
  }
}

TEST_P(HiddenFingers, CloseWithTheThumbBesideASliverOfAFinger) {
  const HandPose before = bent(20, 30, 10, 0), now = bent(20, 30, 10, 10);
  for (int finger = kIndex; finger < kFingerCount; ++finger) hide(seen_, finger);
  seen_[segment_of(kLittle, 0)] = true;
  const auto middle_joint = [&](double shown_of_a_knuckle) {
    std::array<double, kSegmentCount> shown{};
    for (int k = 0; k < 3; ++k) shown[segment_of(kThumb, k)] = 1;
    shown[segment_of(kLittle, 0)] = shown_of_a_knuckle;
    return flexion(with_hidden_following(profile_, before, now, kAtOnce, seen_, shown, stay_, kWidening), kRing, 1);
  };
  EXPECT_NEAR(middle_joint(0.2), 40, 1e-6);
  EXPECT_NEAR(middle_joint(0.5), 30, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(BothHands, HiddenFingers, testing::Values(Handedness::right, Handedness::left),
                         [](const auto& info) { return std::string(to_string(info.param)); });

}  // namespace
}  // namespace barehand
