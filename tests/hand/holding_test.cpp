#include "hand/grasps/holding.h"

#include <gtest/gtest.h>

#include <numbers>

namespace barehand {
namespace {

using Eigen::Vector3d;

/// A palm and an object, frame by frame.
class HeldObject : public testing::Test {
 protected:
  ObjectEstimate frame(const Vector3d& palm, const SE3& T_camera_object, const Vector3d& centre = Vector3d::Zero(),
                       TrackStatus status = TrackStatus::tracking) {
    auto estimate = std::make_shared<HandEstimate>();
    estimate->status = status;
    estimate->hand_id = 3;
    estimate->segments[kPalm].T_camera_segment.t = palm;
    estimates_ = {estimate};
    utime_ += 33'000;
    ObjectEstimate state;
    state.T_camera_object = T_camera_object;
    holding_.update(utime_, estimates_, centre, state);
    return state;
  }
  ObjectEstimate frame(const Vector3d& palm, const Vector3d& object) {
    return frame(palm, SE3{Eigen::Matrix3d::Identity(), object});
  }

  Holding holding_;
  HandEstimates estimates_;
  std::int64_t utime_ = 0;
};

TEST_F(HeldObject, IsHeldOnceItWasCarriedUntilItIsLeft) {
  EXPECT_FALSE(frame({0, 0, 0.5}, {0, 0, 0.45}).held);
  EXPECT_FALSE(frame({0.015, 0, 0.5}, {0.015, 0, 0.45}).held);
  const ObjectEstimate held = frame({0.03, 0, 0.5}, {0.03, 0, 0.45});
  EXPECT_TRUE(held.held);
  EXPECT_EQ(held.hand_id, 3);
  EXPECT_EQ(held.since, utime_);
  EXPECT_EQ(frame({0.03, 0, 0.5}, {0.05, 0, 0.45}).since, held.since) << "it may slip by 20 mm";
  EXPECT_FALSE(frame({0.1, 0, 0.5}, {0.05, 0, 0.45}).held) << "put down";
}

TEST_F(HeldObject, IsHeldWhereverTheHandClosedOnIt) {
  // The palm approaches by 20 mm after the object was first seen, and then carries it.
  frame({0, 0, 0.5}, {0, 0, 0.4});
  frame({0, 0, 0.48}, {0, 0, 0.4});
  ObjectEstimate state;
  for (int k = 1; k <= 5; ++k) state = frame({0.01 * k, 0, 0.48}, {0.01 * k, 0, 0.4});
  EXPECT_TRUE(state.held);
}

TEST_F(HeldObject, ItsMiddleIsWatchedNotItsOrigin) {
  // The origin is 100 mm from the middle, about which the object turns by 10 degrees while the palm carries it.
  const Vector3d centre(0.1, 0, 0);
  ObjectEstimate state;
  for (int k = 0; k <= 5; ++k) {
    const Eigen::Matrix3d R = exp_so3({0, 0, k * 2 * std::numbers::pi / 180});
    const Vector3d middle(0.01 * k, 0, 0.45);
    state = frame({0.01 * k, 0, 0.5}, SE3{R, middle - R * centre}, centre);
  }
  EXPECT_TRUE(state.held);
}

TEST_F(HeldObject, IsPredictedToMoveWithThePalm) {
  frame({0, 0, 0.5}, {0, 0, 0.45});
  auto moved = std::make_shared<HandEstimate>(*estimates_.front());
  moved->segments[kPalm].T_camera_segment.t.x() += 0.04;
  ASSERT_TRUE(holding_.carried({moved}));
  EXPECT_NEAR(holding_.carried({moved})->t.x(), 0.04, 1e-12);
  moved->status = TrackStatus::lost;
  EXPECT_FALSE(holding_.carried({moved}));
}

TEST_F(HeldObject, IsHeldByNobodyWithoutATrackedHand) {
  for (int k = 0; k <= 3; ++k) frame({0.01 * k, 0, 0.5}, {0.01 * k, 0, 0.45});
  const SE3 there{Eigen::Matrix3d::Identity(), {0.03, 0, 0.45}};
  const ObjectEstimate state = frame({0.03, 0, 0.5}, there, Vector3d::Zero(), TrackStatus::lost);
  EXPECT_FALSE(state.held);
  EXPECT_EQ(state.hand_id, -1);
}

}  // namespace
}  // namespace barehand
