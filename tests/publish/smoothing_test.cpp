#include <cmath>

#include "math/random.h"
#include "published_hand.h"
#include "stages/publish/pose_smoother.h"

namespace barehand {
namespace {

constexpr double kFrame = 1 / 30.0;
constexpr std::int64_t kFrame_us = 33'333;

SE3 shifted(double x) { return {Eigen::Matrix3d::Identity(), {x, 0, 0}}; }
SE3 turned(double angle) { return {exp_so3({0, 0, angle}), Eigen::Vector3d::Zero()}; }

TEST(OneEuro, StartsAtTheFirstPose) {
  OneEuroPose filter;
  EXPECT_EQ(filter.filter(shifted(0.3), kFrame, {}).t.x(), 0.3);
}

TEST(OneEuro, CalmsAHandAtRest) {
  OneEuroPose filter;
  KeyedRandom random(3, 1);
  double raw_sq = 0, smoothed_sq = 0;
  for (int i = 0; i < 300; ++i) {
    const double x = 0.0005 * random.normal();
    const double y = filter.filter(shifted(x), kFrame, {}).t.x();
    raw_sq += x * x;
    smoothed_sq += y * y;
  }
  EXPECT_LT(smoothed_sq, 0.6 * raw_sq);
}

TEST(OneEuro, FollowsAFastHandClosely) {
  OneEuroPose moving, turning;
  SE3 position, orientation;
  for (int i = 0; i <= 30; ++i) {
    position = moving.filter(shifted(i * kFrame * 1.0), kFrame, {});     // 1 m/s
    orientation = turning.filter(turned(i * kFrame * 6.0), kFrame, {});  // 6 rad/s, by more than half a turn in total
  }
  EXPECT_LT(30 * kFrame * 1.0 - position.t.x(), 0.2 * kFrame) << "lag of a fraction of a frame";
  EXPECT_LT(boxminus(turned(30 * kFrame * 6.0), orientation).norm(), 0.4 * kFrame * 6.0);
}

TEST(OneEuro, ALowerCutOffIsCalmer) {
  OneEuroPose calm, lively;
  for (OneEuroPose* filter : {&calm, &lively}) filter->filter(shifted(0), kFrame, {});
  const double slow = calm.filter(shifted(0.001), kFrame, {.min_cutoff = 0.5}).t.x();
  const double quick = lively.filter(shifted(0.001), kFrame, {.min_cutoff = 10}).t.x();
  EXPECT_LT(slow, quick);
}

HandPose bent(const HandProfile& profile, double flexion) {
  Angles angles{};
  for (int s = 1; s < kSegmentCount; ++s) angles[s].flexion = flexion;
  return forward_kinematics(profile, somewhere(), angles);
}

TEST(PoseSmoother, KeepsJointsClosed) {
  const HandProfile profile = *test::adult_hand(Handedness::right);
  PoseSmoother smoother;
  HandPose smoothed;
  for (int i = 0; i < 10; ++i) smoothed = smoother.smooth(bent(profile, 0.1 * i), i * kFrame_us, {});
  EXPECT_GT(boxminus(bent(profile, 0.9)[15], smoothed[15]).norm(), 1e-3) << "it did smooth";
  for (int s = 1; s < kSegmentCount; ++s) {
    EXPECT_LT((joint_in_parent(profile, smoothed, s) - proximal_end(smoothed, s)).norm(), 1e-9) << s;
  }
}

TEST(PoseSmoother, SwitchedOffReturnsTheRawPose) {
  const HandProfile profile = *test::adult_hand(Handedness::right);
  PoseSmoother smoother;
  for (int i = 0; i < 3; ++i) {
    const HandPose raw = bent(profile, 0.3 * i);
    EXPECT_EQ(smoother.smooth(raw, i * kFrame_us, {.enabled = false})[9].matrix(), raw[9].matrix());
  }
}

TEST(PoseSmoother, StartsAnewAfterAGapAndAReset) {
  const HandProfile profile = *test::adult_hand(Handedness::right);
  const HandPose raw = bent(profile, 0.8);
  PoseSmoother smoother;
  smoother.smooth(bent(profile, 0), 0, {});
  EXPECT_LT(boxminus(smoother.smooth(raw, 2'000'000, {})[9], raw[9]).norm(), 1e-12) << "2 s later";
  smoother.smooth(bent(profile, 0), 2'033'000, {});
  smoother.reset();
  EXPECT_LT(boxminus(smoother.smooth(raw, 2'066'000, {})[9], raw[9]).norm(), 1e-12);
}

TEST(PoseSmoother, WorksBackwardsInTimeToo) {
  const HandProfile profile = *test::adult_hand(Handedness::right);
  PoseSmoother forwards, backwards;
  HandPose a, b;
  for (int i = 0; i < 5; ++i) {
    a = forwards.smooth(bent(profile, 0.1 * i), i * kFrame_us, {});
    b = backwards.smooth(bent(profile, 0.1 * i), (4 - i) * kFrame_us, {});
  }
  EXPECT_EQ(a[12].matrix(), b[12].matrix());
}

}  // namespace
}  // namespace barehand
