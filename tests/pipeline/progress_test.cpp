#include "pipeline/progress.h"

#include <gmock/gmock.h>

#include <sstream>

#include "pipeline/sinks/hand_message_makers.h"
#include "pipeline/summary.h"
#include "support/adult_hand.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;

TrackedFrame tracked(std::int64_t number, TrackStatus status) {
  static const auto profile = test::adult_hand();
  auto estimate = std::make_shared<HandEstimate>();
  estimate->number = number;
  estimate->utime = number * 100'000;
  estimate->status = status;
  estimate->profile = profile;
  return {nullptr, {}, {estimate}};
}

TEST(Progress, OneLineIsRewrittenOnATerminalAndClearedAtTheEnd) {
  ManualClock clock;
  std::ostringstream out;
  ProgressSink progress(out, {true, 100}, clock);
  for (int i = 0; i < 10; ++i) {
    clock.advance(50'000);
    EXPECT_TRUE(progress.consume(tracked(i, TrackStatus::tracking)));
  }
  EXPECT_EQ(out.str(),
            "\r\x1b[K5/100 frames, 20.0 frames/s, frame 4: tracking"
            "\r\x1b[K10/100 frames, 20.0 frames/s, frame 9: tracking");
  EXPECT_TRUE(progress.finish());
  EXPECT_TRUE(out.str().ends_with("\r\x1b[K"));
}

TEST(Progress, AFewWholeLinesElsewhere) {
  ManualClock clock;
  std::ostringstream out;
  ProgressSink progress(out, {false, std::nullopt}, clock);
  for (int i = 0; i < 200; ++i) {
    clock.advance(100'000);
    EXPECT_TRUE(progress.consume(tracked(i, TrackStatus::lost)));
  }
  EXPECT_EQ(out.str(), "100 frames, 10.0 frames/s, frame 99: lost\n200 frames, 10.0 frames/s, frame 199: lost\n");
}

TEST(Progress, CountsFramesByStatus) {
  ManualClock clock;
  std::ostringstream out;
  ProgressSink progress(out, {}, clock);
  for (const auto status : {TrackStatus::searching, TrackStatus::lost, TrackStatus::tracking, TrackStatus::tracking})
    EXPECT_TRUE(progress.consume(tracked(0, status)));
  EXPECT_EQ(progress.counts()[0].of(TrackStatus::tracking), 2);
  EXPECT_EQ(progress.counts()[0].of(TrackStatus::holding), 0);
  EXPECT_EQ(progress.counts()[0].of(TrackStatus::lost), 1);
}

TEST(Progress, CountsAHandAsItIsPublished) {
  // A hand is tracked, and then out of sight for longer than it is held; another one fits badly and is found again.
  ManualClock clock;
  std::ostringstream out;
  Slot<PublishParams> pending;
  ProgressSink progress(out, {false, std::nullopt, false, {}, &pending}, clock);
  HandMessageMakers published({}, nullptr);
  std::array<std::int64_t, 4> logged{};
  using enum TrackStatus;
  const std::vector<TrackStatus> first = {searching, tracking, holding, holding, holding, holding, holding, lost, lost},
                                 second = {tracking, lost, lost, tracking, tracking, tracking, lost, lost, searching};
  for (std::size_t i = 0; i < first.size() + second.size(); ++i) {
    const TrackedFrame frame =
        tracked(static_cast<std::int64_t>(i), i < first.size() ? first[i] : second[i - first.size()]);
    EXPECT_TRUE(progress.consume(frame));
    ++logged[static_cast<std::size_t>(published.process(frame).hands[0].state.status)];
  }
  EXPECT_EQ(progress.counts()[0].frames, logged);
  EXPECT_EQ(logged[static_cast<std::size_t>(holding)], 4 + 4) << "at 0.5 s the hand is not held any more";

  // A hand that a new configuration does not hold is lost at once.
  PublishParams no_hold;
  no_hold.hold_time = 0;
  EXPECT_TRUE(progress.consume(tracked(20, tracking)));
  pending.put(no_hold);
  EXPECT_TRUE(progress.consume(tracked(21, lost)));
  EXPECT_EQ(progress.statuses(), std::vector{lost});
}

TEST(Summary, TellsFramesStatusAndTimes) {
  PipelineHealth health;
  health.captured = 10;
  health.published = 7;
  health.dropped = 2;
  health.failed = 1;
  health.skipped = 3;
  health.stages = {{"track", {7, 0.012, 0.011, 0.02, 0.03, 0.031}, 1}, {"unused", {}, 0}};
  health.queues = {{"transit", 0, 0, 22, 10, 12, {}}, {"inbox", 1, 0, 10, 10, 0, {}}, {"input", 4, 0, 10, 8, 2, {}}};
  StatusCounts status;
  status.frames = {1, 5, 0, 1};
  const std::string text = summary(health, {status}, 2.0);
  EXPECT_THAT(text, HasSubstr("10 frames in 2.0 s (3.5 frames/s): 7 published, 2 dropped, 1 failed; 3 unreadable"));
  EXPECT_THAT(text, HasSubstr("\ndropped by transit 12, input 2\n"));
  EXPECT_THAT(text, HasSubstr("tracked in 5 frames, held in 0, lost in 1, searched for in 1"));
  EXPECT_THAT(text, HasSubstr("track                   7    12.00    11.00    20.00    30.00    31.00"));
  EXPECT_EQ(text.find("unused"), std::string::npos);
  EXPECT_THAT(health_line(health), HasSubstr("[transit 0/0, 12 dropped] [inbox 0/1] [input 0/4, 2 dropped]"));
}

}  // namespace
}  // namespace barehand
