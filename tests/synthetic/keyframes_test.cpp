#include "drivers/synthetic/sequences/keyframes.h"

#include <gtest/gtest.h>

namespace barehand::synthetic {
namespace {

TEST(SmoothTrack, PassesThroughItsKeysAndHoldsOutside) {
  const SmoothTrack track({0, 1, 3}, {{0, 5}, {2, 5}, {1, 5}});
  EXPECT_DOUBLE_EQ(track.at(-1)[0], 0);
  EXPECT_DOUBLE_EQ(track.at(1)[0], 2);
  EXPECT_DOUBLE_EQ(track.at(9)[0], 1);
}

TEST(SmoothTrack, NeverOvershootsAndKeepsStillWhatIsStill) {
  const SmoothTrack track({0, 1, 1.2, 3}, {{0, 5}, {2, 5}, {2, 5}, {1, 5}});
  for (double t = 0; t <= 3; t += 0.01) {
    EXPECT_GE(track.at(t)[0], 0);
    EXPECT_LE(track.at(t)[0], 2 + 1e-12);
    EXPECT_DOUBLE_EQ(track.at(t)[1], 5);
  }
}

TEST(SmoothTrack, HasNoKinks) {
  const SmoothTrack track({0, 1, 2.5, 3}, {{0}, {1}, {4}, {4.5}});
  const double h = 1e-5;
  for (const double key : {1.0, 2.5}) {
    const double before = (track.at(key)[0] - track.at(key - h)[0]) / h;
    const double after = (track.at(key + h)[0] - track.at(key)[0]) / h;
    EXPECT_NEAR(before, after, 1e-3);
  }
}

TEST(Tremor, IsSmallSmoothAndKeyedBySeed) {
  const SkeletonPose still;
  for (double t = 0; t < 5; t += 0.1) {
    const SkeletonPose moved = with_tremor(still, t, 7);
    EXPECT_LT(moved.T_camera_palm.t.norm(), 0.003);
    EXPECT_LT((with_tremor(still, t + 0.001, 7).T_camera_palm.t - moved.T_camera_palm.t).norm(), 5e-5);
  }
  EXPECT_EQ(with_tremor(still, 1, 7).T_camera_palm.t, with_tremor(still, 1, 7).T_camera_palm.t);
  EXPECT_NE(with_tremor(still, 1, 7).T_camera_palm.t, with_tremor(still, 1, 8).T_camera_palm.t);
}

}  // namespace
}  // namespace barehand::synthetic
