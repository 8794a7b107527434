#include "stages/detection/second_look.h"

#include "support/rendered_person.h"

namespace barehand {
namespace {

/// A tracked hand before a camera, of which a fingertip is not seen.
class SecondLookTest : public ::testing::Test {
 protected:
  void SetUp() override {
    test::RenderedPerson person(test::vga_camera());
    const HandPose pose = test::facing_pose(*profile_, 0.6);
    person.hand(*profile_, pose, pose[kPalm].t + Eigen::Vector3d(0.05, 0.14, 0.17));
    frame_ = person.frame();
    auto detector = HandDetector::load(std::string(BAREHAND_CONFIGS) + "/nets", DetectionParams{});
    ASSERT_TRUE(detector);
    detector_.emplace(std::move(*detector));

    hand_.status = TrackStatus::tracking;
    hand_.profile = profile_;
    for (int s = 0; s < kSegmentCount; ++s) {
      hand_.segments[s].T_camera_segment = pose[s];
      hand_.segments[s].seen = s != kSegmentCount - 1;
    }
  }
  /// The frames of the next `n`, from 0, in which the result of a look comes.
  std::vector<int> frames_with_result(SecondLook& look, int n) {
    std::vector<int> frames;
    for (int i = 0; i < n; ++i) {
      const std::vector<HandEstimatePtr> feedback = {std::make_shared<const HandEstimate>(hand_)};
      const auto found = look.next(frame_, feedback, *detector_, workers_);
      EXPECT_TRUE(found);
      if (!*found) continue;
      frames.push_back(i);
      last_ = **found;
    }
    return frames;
  }

  Workers workers_{1};
  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  std::shared_ptr<RgbdFrame> frame_;
  HandEstimate hand_;
  std::optional<HandDetector> detector_;
  DetectedHand last_;
};

TEST_F(SecondLookTest, ComesTwoFramesAfterEveryNth) {
  SecondLook look(5);
  EXPECT_EQ(frames_with_result(look, 14), (std::vector{2, 7, 12}));
  EXPECT_LT((last_.centre - hand_.segments[kPalm].T_camera_segment.t).norm(), 0.06);
}

TEST_F(SecondLookTest, ComesSoonerIfTheHandIsAmbiguous) {
  SecondLook rare(100), again(100);
  EXPECT_EQ(frames_with_result(rare, 14), (std::vector{2}));
  hand_.ambiguous = true;
  EXPECT_EQ(frames_with_result(again, 14), (std::vector{2, 7, 12}));
}

TEST_F(SecondLookTest, IsNotTakenAtAHandThatIsSeenOrLostOrWhenSwitchedOff) {
  SecondLook never(0);
  EXPECT_TRUE(frames_with_result(never, 4).empty());
  SecondLook always(1);
  hand_.status = TrackStatus::holding;
  EXPECT_TRUE(frames_with_result(always, 4).empty());
  hand_.status = TrackStatus::tracking;
  hand_.segments[kSegmentCount - 1].seen = true;
  EXPECT_TRUE(frames_with_result(always, 4).empty());
}

TEST_F(SecondLookTest, MovesWithThePalm) {
  SecondLook still(100), moving(100);
  frames_with_result(still, 3);
  const DetectedHand before = last_;
  frames_with_result(moving, 2);
  for (SegmentState& segment : hand_.segments) segment.T_camera_segment.t.x() += 0.02;
  ASSERT_EQ(frames_with_result(moving, 1).size(), 1u);
  for (int k = 0; k < kLandmarkCount; ++k)
    EXPECT_LT((last_.joints[k].position - before.joints[k].position - Eigen::Vector3d(0.02, 0, 0)).norm(), 1e-9) << k;
}

TEST_F(SecondLookTest, OfAHandThatIsLostMeanwhileIsDropped) {
  SecondLook look(100);
  frames_with_result(look, 2);
  hand_.status = TrackStatus::lost;
  EXPECT_TRUE(frames_with_result(look, 3).empty());
}

}  // namespace
}  // namespace barehand
