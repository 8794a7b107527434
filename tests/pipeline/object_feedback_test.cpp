#include "pipeline/object_feedback.h"

#include <gtest/gtest.h>

#include <thread>

#include "support/solid_meshes.h"

namespace barehand {
namespace {

const KnownObjectPtr kBox = make_known_object(test::box_mesh({0.05f, 0.04f, 0.03f}), 1);

const Eigen::Matrix3d kTurned = exp_so3({0.3, -1, 0.5});  // orientation of the palm

PosedObject at(const Eigen::Vector3d& place, double deviation, std::int32_t hand_id) {
  return {kBox, {Eigen::Matrix3d::Identity(), place}, deviation * deviation * Matrix6d::Identity(), hand_id};
}

HandEstimates hand_at(const SE3& T_camera_palm, TrackStatus status) {
  auto estimate = std::make_shared<HandEstimate>();
  estimate->hand_id = 4;
  estimate->status = status;
  estimate->segments[kPalm].T_camera_segment = T_camera_palm;
  return {estimate};
}

/// Moves an object and a palm in steps, and returns where the object is placed in the end.
NearbyObject placed_after(const Eigen::Vector3d& object_step, const Eigen::Vector3d& palm_step,
                          TrackStatus status = TrackStatus::tracking) {
  ObjectPlaces places;
  FrameVector<NearbyObject> nearby;
  for (int i = 0; i < 4; ++i) {
    const std::array objects = {at(Eigen::Vector3d(0.1, 0.05, 0.6) + i * object_step, 0.001, -1)};
    nearby = places.place(objects, hand_at({kTurned, i * palm_step}, status));
  }
  EXPECT_EQ(nearby.size(), 1u);
  return nearby.at(0);
}

TEST(ObjectPlaces, AnObjectThatMovesWithThePalmIsPlacedInIt) {
  const Eigen::Vector3d step(0.004, 0, 0.002);
  const NearbyObject carried = placed_after(step, step);
  EXPECT_EQ(carried.hand_id, 4);
  EXPECT_LT((kTurned * carried.T_base_object.t - Eigen::Vector3d(0.1, 0.05, 0.6)).norm(), 1e-12);
}

TEST(ObjectPlaces, AnObjectThatThePalmLeavesIsPlacedInTheCameraFrame) {
  const NearbyObject left = placed_after(Eigen::Vector3d::Zero(), {0.004, 0, 0.002});
  EXPECT_EQ(left.hand_id, -1);
  EXPECT_EQ(left.T_base_object.t, Eigen::Vector3d(0.1, 0.05, 0.6));
  const Eigen::Vector3d step(0.004, 0, 0.002);
  EXPECT_EQ(placed_after(step, step, TrackStatus::lost).hand_id, -1) << "without a tracked hand";
}

TEST(ObjectPlaces, AnObjectThatAHandHoldsIsItsWhereverItIsPlaced) {
  // A hand that is lost holds it.
  const std::array held = {at({0.1, 0.05, 0.6}, 0.001, 7)};
  const NearbyObject placed = ObjectPlaces().place(held, {}).at(0);
  EXPECT_EQ(placed.hand_id, -1);
  EXPECT_EQ(placed.holder_id, 7);
}

TEST(ObjectPlaces, AnObjectWhosePlaceIsUncertainIsLeftOut) {
  const std::array objects = {at({0.1, 0.05, 0.6}, 0.02, -1)};
  EXPECT_TRUE(ObjectPlaces().place(objects, {}).empty());
}

/// As many objects as the number of the frame says.
FrameVector<NearbyObject> of_frame(std::size_t number) { return FrameVector<NearbyObject>(number); }

TEST(ObjectFeedback, TheTrackerGetsTheObjectsOfAFixedNumberOfFramesBefore) {
  // The other thread posts late.
  ObjectFeedback feedback;
  constexpr std::size_t kFrames = 20, kLag = ObjectFeedback::kLag;
  std::jthread sinks([&] {
    for (std::size_t i = 0; i < kFrames; ++i) {
      std::this_thread::yield();
      feedback.post(of_frame(i));
    }
  });

  // Frames in which the tracker fails get the same objects again.
  for (std::size_t k = 0; k < kFrames; ++k) {
    const std::size_t expected = k < kLag ? 0 : k - kLag;
    EXPECT_EQ(feedback.wait().size(), expected);
    EXPECT_EQ(feedback.wait().size(), expected) << "after a failure";
    feedback.next();
  }
}

TEST(ObjectFeedback, TheTrackerGetsNoObjectsOfAFrameThatFailed) {
  ObjectFeedback feedback;
  for (const bool fails : {false, true, false}) {
    try {
      ObjectFeedback::Posting posting{&feedback};
      if (fails) throw std::runtime_error("no objects");
      posting.objects = of_frame(5);
    } catch (const std::runtime_error&) {
    }
  }
  for (std::int64_t k = 0; k < ObjectFeedback::kLag; ++k) feedback.next();
  for (const std::size_t expected : {5, 0, 5}) {
    EXPECT_EQ(feedback.wait().size(), expected);
    feedback.next();
  }
}

}  // namespace
}  // namespace barehand
