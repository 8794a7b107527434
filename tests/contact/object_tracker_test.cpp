#include "stages/contact/object_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace barehand {
namespace {

using Eigen::Vector3f;

constexpr std::int64_t kFrame = 33'000;  // [us]

/// Frames with a palm and square pieces of surface.
class Objects : public testing::Test {
 protected:
  void piece(const Vector3f& centre, bool open = false, int from = -4, int to = 4) {
    for (int i = from; i <= to; ++i)
      for (int j = -4; j <= 4; ++j)
        points_.push_back({centre + Vector3f(0.003f * i, 0.003f * j, 0), {0, 0, -1}, static_cast<int>(open_.size())});
    open_.push_back(open);
  }
  /// Tracks one frame with the pieces that were added since the last one.
  const FrameVector<ObjectEstimate>& frame(const Eigen::Vector3d& palm = {0, 0, 0.5}) {
    auto estimate = std::make_shared<HandEstimate>();
    estimate->status = TrackStatus::tracking;
    estimate->hand_id = 3;
    estimate->segments[kPalm].T_camera_segment.t = palm;
    objects_.clear();
    utime_ += kFrame;
    tracker_.process(utime_, {estimate}, space_, open_, points_, objects_);
    for (const ObjectTrack& track : tracker_.tracks()) EXPECT_TRUE(track.points.empty()) << "they are of this frame";
    left_ = points_;
    points_.clear();
    open_.clear();
    return objects_;
  }

  ObservedSpace space_;  // nothing is seen to be empty
  ObjectTracker tracker_;
  std::vector<SurfacePoint> points_, left_;
  std::vector<bool> open_;
  FrameVector<ObjectEstimate> objects_;
  std::int64_t utime_ = 0;
};

TEST_F(Objects, PiecesAFingersWidthApartAreOneAndFarOnesAreTwo) {
  piece({0, 0, 0.5f});
  piece({0.035f, 0, 0.5f});  // 11 mm between their borders
  EXPECT_EQ(frame().size(), 1u);
  piece({0, 0, 0.5f});
  piece({0.09f, 0, 0.5f});
  EXPECT_EQ(frame().size(), 2u);
}

TEST_F(Objects, AnIdStaysWhileTheObjectMoves) {
  piece({0, 0, 0.5f});
  const std::int32_t id = frame()[0].id;
  EXPECT_GE(id, kFirstUnknownObject);
  for (int k = 1; k < 10; ++k) {
    piece({0.02f * k, 0, 0.5f});
    ASSERT_EQ(frame().size(), 1u);
    EXPECT_EQ(objects_[0].id, id);
    EXPECT_EQ(left_[0].object, id);
  }
}

TEST_F(Objects, AnIdStaysWhileFingersDivideTheObject) {
  piece({0, 0, 0.5f}, false, -10, 10);
  const std::int32_t id = frame()[0].id;
  for (int k = 0; k < 3; ++k) {
    piece({0, 0, 0.5f}, false, -10, -7);
    piece({0, 0, 0.5f}, false, 7, 10);
    ASSERT_EQ(frame().size(), 1u);
    EXPECT_EQ(objects_[0].id, id);
    EXPECT_NEAR(objects_[0].T_camera_object.t.x(), 0, 1e-3);
  }
}

TEST_F(Objects, WhatIsHiddenIsRemembered) {
  for (int k = 0; k < 3; ++k) {
    piece({0, 0, 0.5f}, false, -10, 10);
    frame();
  }
  piece({0, 0, 0.5f}, false, -10, 0);
  frame();
  EXPECT_TRUE(std::any_of(left_.begin(), left_.end(), [&](const SurfacePoint& point) {
    return point.object == objects_[0].id && point.p.x() > 0.025f && std::abs(point.p.z() - 0.5f) < 0.001f;
  }));
}

TEST_F(Objects, ATableIsNotJoinedToWhatStandsOnIt) {
  piece({0, 0, 0.5f}, true, -10, 10);
  piece({0, 0, 0.49f});
  EXPECT_EQ(frame().size(), 2u);
}

TEST_F(Objects, ATableIsNotGivenToTheModelOfWhatStoodThere) {
  piece({0, 0, 0.5f});
  const std::int32_t id = frame()[0].id;
  piece({0, 0, 0.5f}, true);  // now it is connected with a table
  frame();
  EXPECT_NE(left_[0].object, id);
}

TEST_F(Objects, WhatIsConnectedWithATableForAWhileIsNotForgotten) {
  piece({0, 0, 0.5f});
  const std::int32_t id = frame()[0].id;
  for (int k = 0; k < 40; ++k) {
    piece({0, 0, 0.5f}, true);
    frame();
  }
  piece({0, 0, 0.5f});
  frame();
  EXPECT_EQ(left_[0].object, id);
}

TEST_F(Objects, APieceThatIsFlushWithATableIsAPartOfIt) {
  piece({0, 0, 0.5f}, true, -10, 0);
  piece({0, 0, 0.5f}, false, 3, 10);
  EXPECT_EQ(frame().size(), 1u);
}

TEST_F(Objects, AHeldObjectMovesWithThePalm) {
  for (int k = 0; k < 8; ++k) {
    piece({0.01f * k, 0, 0.45f});
    frame({0.01 * k, 0, 0.5});
  }
  EXPECT_NEAR(objects_[0].velocity[0], 0.01 / (1e-6 * kFrame), 0.06);
  EXPECT_NEAR(objects_[0].T_camera_object.t.x(), 0.07, 0.004);
}

TEST_F(Objects, AnotherPlaceOrALongAbsenceIsAnotherObject) {
  piece({0, 0, 0.5f});
  const std::int32_t first = frame()[0].id;
  piece({0.2f, 0, 0.5f});
  const std::int32_t second = frame()[0].id;
  EXPECT_NE(second, first);
  for (int k = 0; k < 20; ++k) frame();
  piece({0.2f, 0, 0.5f});
  EXPECT_NE(frame()[0].id, second);
}

TEST_F(Objects, WhatAHandTouchesIsRememberedWhileFingersCoverIt) {
  piece({0, 0, 0.5f});
  const std::int32_t id = frame()[0].id;
  HandContacts contacts;
  contacts.object[segment_of(1, 2)].state = ContactState::touching;
  contacts.object[segment_of(1, 2)].partner = id;
  for (int k = 0; k < 30; ++k) {
    tracker_.note_touches({&contacts, 1});
    frame();
  }
  piece({0, 0, 0.5f});
  EXPECT_EQ(frame()[0].id, id);
}

TEST_F(Objects, SpecksAreNone) {
  points_.assign(4, {{0, 0, 0.5f}, {0, 0, -1}, 0});
  open_ = {false};
  EXPECT_TRUE(frame().empty());
  EXPECT_TRUE(left_.empty());
}

TEST_F(Objects, WhatMovesWithThePalmIsHeldUntilItIsLeft) {
  for (int k = 0; k < 5; ++k) {
    piece({0.01f * k, 0, 0.45f});
    frame({0.01 * k, 0, 0.5});
  }
  EXPECT_TRUE(objects_[0].held);
  EXPECT_EQ(objects_[0].hand_id, 3);
  const std::int64_t since = objects_[0].since;
  EXPECT_GT(since, kFrame) << "it was not known to be held in its first frame";

  piece({0.05f, 0, 0.45f});
  EXPECT_EQ(frame({0.05, 0, 0.5})[0].since, since);
  piece({0.05f, 0, 0.45f});
  EXPECT_FALSE(frame({0.15, 0, 0.5})[0].held) << "put down";
}

TEST_F(Objects, WhatThePalmNearsAndThenCarriesIsHeld) {
  piece({0, 0, 0.45f});
  frame({0, 0, 0.52});
  piece({0, 0, 0.45f});
  frame();  // 20 mm nearer
  for (int k = 0; k < 5; ++k) {
    piece({0.01f * k, 0, 0.45f});
    frame({0.01 * k, 0, 0.5});
  }
  EXPECT_TRUE(objects_[0].held);
}

TEST_F(Objects, WhatContinuesOutOfViewIsNeverHeld) {
  for (int k = 0; k < 5; ++k) {
    piece({0.01f * k, 0, 0.45f}, true);
    EXPECT_FALSE(frame({0.01 * k, 0, 0.5})[0].held);
  }
}

}  // namespace
}  // namespace barehand
