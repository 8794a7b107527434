#include "app/shared/checked_source.h"

#include <gmock/gmock.h>

#include <random>

namespace barehand {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Delivers given frames.
class FrameList : public FrameSource {
 public:
  FrameList(std::vector<FramePtr> frames, bool live) : frames_(std::move(frames)), live_(live) {}
  SourceEvent next(std::chrono::milliseconds) override {
    if (next_ == frames_.size()) return EndOfStream{};
    return frames_[next_++];
  }
  bool live() const override { return live_; }
  std::string name() const override { return "list"; }

 private:
  std::vector<FramePtr> frames_;
  bool live_;
  std::size_t next_ = 0;
};

/// A noisy wall at about `depth` metres, as a sensor sees it.
std::shared_ptr<RgbdFrame> wall(int number, double depth = 0.8) {
  auto frame = std::make_shared<RgbdFrame>();
  frame->number = number;
  frame->utime = 1'000'000 + 33'333 * number;
  frame->camera = {64, 48, 52.5, 52.5, 31.5, 23.5};
  frame->depth = Image<std::uint16_t>(64, 48);
  std::minstd_rand random(static_cast<unsigned>(number) + 1);
  std::uniform_int_distribution<int> noise(-3, 3);
  for (std::size_t i = 0; i < frame->depth.size(); ++i)
    frame->depth[i] = static_cast<std::uint16_t>(std::lround(1000 * depth) + noise(random));
  return frame;
}

class Watched : public testing::Test {
 protected:
  void add(std::shared_ptr<RgbdFrame> frame) { frames_.push_back(std::move(frame)); }
  /// Numbers of the frames that are delivered. The notices and the skipped frames are kept in members.
  std::vector<std::int64_t> play(bool live = false) {
    CheckedSource source(std::make_unique<FrameList>(frames_, live), DepthLimits{0.12, 1.5}, clock_);
    std::vector<std::int64_t> numbers;
    while (true) {
      const SourceEvent event = source.next(std::chrono::milliseconds(0));
      if (const auto* frame = std::get_if<FramePtr>(&event)) numbers.push_back((*frame)->number);
      if (const auto* skipped = std::get_if<SkippedFrame>(&event)) skipped_.push_back(skipped->error.message());
      if (const auto* notice = std::get_if<SourceNotice>(&event)) said_.push_back(notice->error.message());
      if (std::holds_alternative<EndOfStream>(event)) return numbers;
    }
  }

  ManualClock clock_;
  std::vector<FramePtr> frames_;
  std::vector<std::string> said_, skipped_;
};

TEST_F(Watched, WhatIsWellIsPassedOnWithoutAWord) {
  for (int i = 0; i < 100; ++i) add(wall(i));
  EXPECT_EQ(play().size(), 100u);
  EXPECT_EQ(play(true).size(), 100u);
  EXPECT_THAT(said_, IsEmpty());
  EXPECT_THAT(skipped_, IsEmpty());
}

TEST_F(Watched, ColourThatIsLeftOutIsSaidOnceBeforeItsFrame) {
  for (int i = 0; i < 50; ++i) {
    auto frame = wall(i);
    if (i >= 20) frame->colour_fault = "it is torn";
    add(frame);
  }
  EXPECT_EQ(play().size(), 50u);
  EXPECT_THAT(said_, ElementsAre(AllOf(HasSubstr("colour is not used: it is torn"), HasSubstr("tracking continues"))));
}

TEST_F(Watched, DepthOutOfReachIsSaidWithItsMedian) {
  for (int i = 0; i < 60; ++i) add(wall(i, 6.1));
  EXPECT_EQ(play().size(), 60u);
  EXPECT_THAT(said_, ElementsAre(HasSubstr("nothing lies between 0.12 and 1.5 m, the median is 6.1 m: is "
                                           "depth_units_per_metre (depth_unit of a message), now 1000, right?")));
  said_.clear();
  frames_.resize(3);
  play();
  EXPECT_EQ(said_.size(), 1u) << "a recording shorter than a second";
}

TEST_F(Watched, DepthNearerThanCamerasMeasureIsSaid) {
  for (int i = 0; i < 60; ++i) add(wall(i, 0.14));
  play();
  EXPECT_THAT(said_, ElementsAre(AllOf(HasSubstr("the median is 0.14 m"), HasSubstr("depth_units_per_metre"))));
}

TEST_F(Watched, AHandThatComesIntoAnEmptyRoomIsWithinReach) {
  for (int i = 0; i < 60; ++i) {
    auto frame = wall(i, 2.5);
    if (i > 20)
      for (int v = 20; v < 28; ++v)
        for (int u = 20; u < 28; ++u) frame->depth.at(u, v) = static_cast<std::uint16_t>(600 + (u + v + i) % 5);
    add(frame);
  }
  play();
  EXPECT_THAT(said_, IsEmpty());
}

TEST_F(Watched, NoDepthAtAllIsSaid) {
  for (int i = 0; i < 60; ++i) {
    add(wall(i));
    std::const_pointer_cast<RgbdFrame>(frames_.back())->depth.reset(64, 48);
  }
  EXPECT_EQ(play().size(), 60u);
  EXPECT_EQ(play(true).size(), 60u) << "an honest picture of nothing, in which a hand is lost";
  EXPECT_THAT(said_, Each(HasSubstr("no pixel has depth")));
}

TEST_F(Watched, IntrinsicsAreLookedAtOnceForEachCamera) {
  for (int i = 0; i < 40; ++i) {
    auto frame = wall(i);
    frame->camera.fx = frame->camera.fy = i < 20 ? 600 : 52.5;
    add(frame);
  }
  play();
  EXPECT_THAT(said_, ElementsAre(HasSubstr("field of view")));
}

TEST_F(Watched, ARecordingThatStandsStillIsSaidAndPlayed) {
  for (int i = 0; i < 100; ++i) {
    add(wall(i));
    if (i > 20 && i < 80) std::const_pointer_cast<RgbdFrame>(frames_.back())->depth = frames_[20]->depth;
  }
  EXPECT_EQ(play().size(), 100u);
  EXPECT_THAT(said_,
              ElementsAre(AllOf(HasSubstr("the depth image is frozen: from frame 20 to 51"), HasSubstr("for 1.03 s"))));
}

TEST_F(Watched, AMomentOfStandingStillIsNotWorthAWord) {
  for (int i = 0; i < 100; ++i) {
    add(wall(i));
    if (i % 20 > 0) std::const_pointer_cast<RgbdFrame>(frames_.back())->depth = frames_[i - i % 20]->depth;
  }
  play();
  EXPECT_THAT(said_, IsEmpty());
}

TEST_F(Watched, OfALiveSourcePicturesThatRepeatAreSkipped) {
  for (int i = 0; i < 6; ++i) {
    add(wall(i));
    if (i == 2 || i == 3) std::const_pointer_cast<RgbdFrame>(frames_.back())->depth = frames_[1]->depth;
  }
  EXPECT_THAT(play(true), ElementsAre(0, 1, 4, 5));
  EXPECT_THAT(skipped_, ElementsAre(HasSubstr("is identical to the previous one"), HasSubstr("identical")));
}

TEST_F(Watched, NoiseIsSkippedOfALiveSourceAndSaidOfARecording) {
  std::minstd_rand random(7);
  for (int i = 0; i < 4; ++i) {
    auto frame = wall(i);
    if (i == 2)
      for (std::size_t k = 0; k < frame->depth.size(); ++k) frame->depth[k] = static_cast<std::uint16_t>(random() >> 8);
    add(frame);
  }
  EXPECT_THAT(play(true), ElementsAre(0, 1, 3));
  EXPECT_THAT(skipped_, ElementsAre(HasSubstr("is noise")));
  EXPECT_THAT(play(), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(said_, ElementsAre(AllOf(HasSubstr("frame 2 is noise"), HasSubstr("bytes in the right order"))));
}

}  // namespace
}  // namespace barehand
