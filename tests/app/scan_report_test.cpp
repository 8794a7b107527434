#include "app/calibrate/scan_report.h"

#include <gmock/gmock.h>

#include "support/adult_hand.h"

namespace barehand {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class ScanReportTest : public ::testing::Test {
 protected:
  enum Side { kPalmSide, kBack };
  /// A hand that faces the camera. All joints of the fingers are bent by `bent`, two of the thumb by `thumb` [rad];
  /// then the hand is turned by `turned`.
  HandEstimate hand(Side side, double bent, double thumb = 0, double turned = 0) const {
    // The pose.
    HandPose pose = test::facing_pose(*profile_, 0.5, bent);
    for (int s : {segment_of(0, 1), segment_of(0, 2)}) {
      const SE3 joint = pose[parent_of(s)] * profile_->rest_relative(s);
      pose[s] = {joint.R * joint_rotation({thumb, 0, 0}), joint.t};
    }
    pose = test::turned(pose, {0, (side == kBack ? M_PI : 0) + turned, 0}, {0, 0, 0.5});

    // All segments count as seen.
    HandEstimate estimate;
    estimate.status = TrackStatus::tracking;
    estimate.profile = profile_;
    for (int s = 0; s < kSegmentCount; ++s) {
      estimate.segments[s].T_camera_segment = pose[s];
      estimate.segments[s].seen = true;
    }
    return estimate;
  }
  void show(const HandEstimate& estimate, int frames = ScanReport::kEnoughFrames) {
    for (int i = 0; i < frames; ++i) report_.add(estimate);
  }
  /// Adds frames that see a side from three directions, since the thumb's sides are seen only when the hand is turned.
  void show_from(Side side) {
    for (double turned : {-1.0, 0.0, 1.0}) show(hand(side, 0.1, 0, turned));
  }

  const std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  ScanReport report_;
};

TEST_F(ScanReportTest, AsksForWhatWasNotShownYet) {
  EXPECT_THAT(report_.missing(),
              ElementsAre(StartsWith("show the palm side of: palm, thumb_metacarpal"),
                          StartsWith("show the back of: palm"), StartsWith("bend and stretch: thumb_proximal")));
  show_from(kPalmSide);
  EXPECT_THAT(report_.missing(), ElementsAre(AllOf(StartsWith("show the back of: palm"), HasSubstr("little_distal")),
                                             StartsWith("bend and stretch")));
  show_from(kBack);
  EXPECT_THAT(report_.missing(), ElementsAre(StartsWith("bend and stretch: thumb_proximal, thumb_distal, index")));
  show(hand(kPalmSide, 0.11 + ScanReport::kEnoughBending), 1);
  EXPECT_THAT(report_.missing(), ElementsAre("bend and stretch: thumb_proximal, thumb_distal"));
  show(hand(kPalmSide, 0.1, ScanReport::kEnoughBending + 0.01), 1);
  EXPECT_THAT(report_.missing(), IsEmpty());
}

TEST_F(ScanReportTest, CountsOnlyWhatWasSeenWhileTracking) {
  // A hand with the status "held" does not count.
  HandEstimate held = hand(kPalmSide, 0.1);
  held.status = TrackStatus::holding;
  show(held);
  EXPECT_EQ(report_.frames(), 0);

  // Neither does a hidden segment.
  HandEstimate hidden = hand(kPalmSide, 0.1);
  hidden.segments[segment_of(1, 2)].seen = false;
  show(hidden);
  EXPECT_EQ(report_.frames(), ScanReport::kEnoughFrames);
  EXPECT_EQ(report_.segment(segment_of(1, 2)).palm_side, 0);
  EXPECT_EQ(report_.segment(segment_of(2, 2)).palm_side, ScanReport::kEnoughFrames);

  // The report asks for what is missing.
  ASSERT_THAT(report_.missing(), Not(IsEmpty()));
  EXPECT_THAT(report_.missing().front(),
              AllOf(StartsWith("show the palm side of"), HasSubstr("index_distal"), Not(HasSubstr("middle"))));
}

}  // namespace
}  // namespace barehand
