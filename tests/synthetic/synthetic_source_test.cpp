#include "drivers/synthetic/synthetic_source.h"

#include <gtest/gtest.h>

namespace barehand::synthetic {
namespace {

using std::chrono::milliseconds;

std::unique_ptr<SyntheticSource> open(const std::string& text, const Clock& clock) {
  auto source = SyntheticSource::open(text + ",width=80,height=60", clock);
  if (!source) throw std::runtime_error(source.error().message());
  return std::move(*source);
}

FramePtr frame_of(const SourceEvent& event) {
  const auto* frame = std::get_if<FramePtr>(&event);
  return frame ? *frame : nullptr;
}

TEST(SyntheticSource, DeliversEveryFrameOnceWithItsTruth) {
  const ManualClock clock;
  const auto source = open("fist,frames=4", clock);
  EXPECT_FALSE(source->live());
  EXPECT_EQ(source->remaining(), 4);

  // Frames come in order, each with its truth.
  for (std::int64_t i = 0; i < 4; ++i) {
    const FramePtr frame = frame_of(source->next(milliseconds(0)));
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->number, i);
    EXPECT_EQ(frame->utime, 1'000'000 + 40'000 * i);
    EXPECT_EQ(frame->colour.width(), 80);
    ASSERT_TRUE(source->hands().front().truth);
    EXPECT_EQ(source->hands().front().truth->number, i);
  }
  EXPECT_TRUE(std::holds_alternative<EndOfStream>(source->next(milliseconds(0))));
}

TEST(SyntheticSource, LiveFramesComeWhenTheyAreDue) {
  ManualClock clock(5'000'000);
  const auto source = open("fist,live=true", clock);
  EXPECT_TRUE(source->live());
  EXPECT_EQ(frame_of(source->next(milliseconds(0)))->utime, 5'000'000);
  EXPECT_TRUE(std::holds_alternative<Timeout>(source->next(milliseconds(0))));
  clock.advance(40'000);
  EXPECT_EQ(frame_of(source->next(milliseconds(0)))->number, 1);
  EXPECT_TRUE(std::holds_alternative<Timeout>(source->next(milliseconds(0))));
}

TEST(SyntheticSource, LiveFramesThatNobodyFetchedAreLeftOut) {
  ManualClock clock;
  const auto source = open("fist,live=true", clock);
  ASSERT_TRUE(frame_of(source->next(milliseconds(0))));
  clock.advance(10 * 40'000 + 5'000);
  EXPECT_EQ(frame_of(source->next(milliseconds(0)))->number, 10);
  clock.advance(100'000'000);
  EXPECT_TRUE(std::holds_alternative<EndOfStream>(source->next(milliseconds(0))));
}

TEST(SyntheticSource, HasAFrameHoweverFastTheMotion) {
  const ManualClock clock;
  const auto source = open("fist,fps=1,speed=20,loop=true", clock);
  EXPECT_TRUE(frame_of(source->next(milliseconds(0))));
  EXPECT_EQ(frame_of(source->next(milliseconds(0)))->utime, 2'000'000);
}

TEST(SyntheticSource, RefusesARateNobodyWaitsFor) {
  const ManualClock clock;
  EXPECT_FALSE(SyntheticSource::open("fist,fps=0.01", clock));
}

TEST(SyntheticSource, LoopStartsAgainWithTimeGoingOn) {
  const ManualClock clock;
  const auto source = open("fist,frames=2,loop=true", clock);
  const FramePtr first = frame_of(source->next(milliseconds(0)));
  (void)source->next(milliseconds(0));
  const FramePtr third = frame_of(source->next(milliseconds(0)));
  ASSERT_TRUE(third);
  EXPECT_EQ(third->number, 2);
  EXPECT_EQ(third->utime, 1'080'000);
  EXPECT_TRUE(std::equal(first->depth.data(), first->depth.data() + first->depth.size(), third->depth.data()));
}

}  // namespace
}  // namespace barehand::synthetic
