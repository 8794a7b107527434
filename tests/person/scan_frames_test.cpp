#include "person/scan_frames.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

class ScanFramesTest : public ::testing::Test {
 protected:
  static constexpr int kSettling = 60, kMost = 64;

  void show(int frames, TrackStatus status = TrackStatus::tracking) {
    for (int i = 0; i < frames; ++i) {
      HandEstimate estimate;
      estimate.status = status;
      estimate.segments[kPalm].T_camera_segment.t.z() = shown_;
      frames_.add(std::make_shared<HandObservation>(), estimate);
      if (status == TrackStatus::tracking) ++shown_;
    }
  }
  std::vector<int> kept() const {
    std::vector<int> numbers;
    for (const ScanFrame& frame : frames_.frames()) numbers.push_back(static_cast<int>(frame.pose[kPalm].t.z()));
    return numbers;
  }

  ScanFrames frames_{kSettling, kMost};
  int shown_ = 0;  // number of tracked frames
};

TEST_F(ScanFramesTest, LeavesOutTheBeginningAndWhatIsNotTracked) {
  show(kSettling - 1);
  show(50, TrackStatus::lost);
  show(1);
  EXPECT_TRUE(kept().empty());
  show(10, TrackStatus::holding);
  show(2);
  EXPECT_EQ(kept(), (std::vector<int>{kSettling, kSettling + 1}));
  EXPECT_EQ(frames_.tracked(), kSettling + 2);
}

TEST_F(ScanFramesTest, AreSpreadEvenlyOverAScanOfAnyLength) {
  for (const int length : {100, 900, 5000}) {
    frames_ = {kSettling, kMost};
    shown_ = 0;
    show(kSettling + length);
    const std::vector<int> numbers = kept();
    ASSERT_GE(static_cast<int>(numbers.size()), kMost / 2) << length;
    ASSERT_LE(static_cast<int>(numbers.size()), kMost) << length;
    const int step = numbers[1] - numbers[0];
    for (std::size_t i = 1; i < numbers.size(); ++i) ASSERT_EQ(numbers[i] - numbers[i - 1], step) << length;
    EXPECT_EQ(numbers.front(), kSettling);
    EXPECT_GT(numbers.back(), kSettling + length - 2 * step);
  }
}

}  // namespace
}  // namespace barehand
