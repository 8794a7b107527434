#include "drivers/lcm/lcm_live_source.h"

#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>

#include "barehand/command_t.hpp"
#include "core/glob.h"
#include "drivers/lcm/frame_codec.h"
#include "drivers/lcm/layouts.h"
#include "test_frames.h"

namespace barehand {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::chrono::milliseconds kLong(10'000);  // a timeout that is reached only by failing tests

Bytes frame_bytes(std::int64_t number) { return encode_message(encode_frame(test_frame(number), {}).value()); }

class LcmLive : public testing::Test {
 protected:
  void send(const std::string& channel, const Bytes& message) { ASSERT_TRUE(bus_->send(channel, message, 0)); }
  /// Blocks until the receiving thread has received `count` messages.
  void wait_received(std::int64_t count) {
    while (source_.counts().received < count) std::this_thread::yield();
  }
  std::shared_ptr<LcmBus> bus_ = LcmBus::open("memq://").value();
  LcmLiveSource source_{bus_, {}};
};

TEST_F(LcmLive, DeliversAFrame) {
  send("LEFT_RGBD_FRAME", frame_bytes(7));
  const SourceEvent event = source_.next(kLong);
  expect_same_frame(*std::get<FramePtr>(event), test_frame(7));
  EXPECT_TRUE(source_.live());
}

TEST_F(LcmLive, SaysWhenNothingCame) {
  EXPECT_TRUE(std::holds_alternative<Timeout>(source_.next(std::chrono::milliseconds(1))));
}

TEST_F(LcmLive, TheNewestFrameWinsAndTheOthersAreCounted) {
  for (int number = 1; number <= 4; ++number) send("RGBD_FRAME", frame_bytes(number));
  wait_received(4);
  EXPECT_EQ(std::get<FramePtr>(source_.next(kLong))->number, 4);
  EXPECT_EQ(source_.counts().replaced, 3);
  EXPECT_EQ(source_.counts().lost, 0);
}

TEST_F(LcmLive, AQueueMissesNothingUntilItIsFull) {
  const std::shared_ptr<LcmBus> bus = LcmBus::open("memq://").value();
  LcmLiveSource source(bus, {.capacity = 3});
  for (int number = 1; number <= 4; ++number) ASSERT_TRUE(bus->send("RGBD_FRAME", frame_bytes(number), 0));
  while (source.counts().received < 4) std::this_thread::yield();
  for (int number = 2; number <= 4; ++number) EXPECT_EQ(std::get<FramePtr>(source.next(kLong))->number, number);
  EXPECT_EQ(source.counts().replaced, 1);
}

TEST_F(LcmLive, GapsInTheNumbersAreCountedAsLost) {
  for (const int number : {1, 2, 5, 4, 6}) send("RGBD_FRAME", frame_bytes(number));
  wait_received(5);
  EXPECT_EQ(source_.counts().lost, 1) << "3 is lost, 4 was only late";
}

TEST_F(LcmLive, QueuesBalance) {
  for (const int number : {1, 2, 5}) send("RGBD_FRAME", frame_bytes(number));
  wait_received(3);
  const std::vector<QueueHealth> queues = source_.queues();
  ASSERT_EQ(queues.size(), 2u);
  EXPECT_EQ(queues[0].dropped, 2) << "3 and 4";
  EXPECT_EQ(queues[1].depth, 1u);
  EXPECT_EQ(queues[1].popped, 0);
  for (const QueueHealth& q : queues)
    EXPECT_EQ(q.pushed, q.popped + q.dropped + static_cast<std::int64_t>(q.depth)) << q.name;
}

TEST_F(LcmLive, ASenderThatStartsAgainLosesNothing) {
  for (const int number : {500, 501, 0, 1}) send("RGBD_FRAME", frame_bytes(number));
  wait_received(4);
  EXPECT_EQ(source_.counts().lost, 0);
}

TEST_F(LcmLive, ASenderThatRepeatsAShortClipLosesNothing) {
  for (const int number : {18, 19, 20, 1, 2, 3, 4, 5, 8}) send("RGBD_FRAME", frame_bytes(number));
  wait_received(9);
  EXPECT_EQ(source_.counts().lost, 2) << "6 and 7";
}

TEST_F(LcmLive, NumbersThatJumpAgainAndAgainAreNotCounted) {
  // Two programs that send on one channel.
  for (const int number : {100, 5000, 101, 5001, 102, 5002, 103, 5003, 104}) send("RGBD_FRAME", frame_bytes(number));
  wait_received(9);
  EXPECT_EQ(source_.counts().lost, 0);
  const SourceEvent notice = source_.next(kLong);
  ASSERT_TRUE(std::holds_alternative<SourceNotice>(notice));
  EXPECT_THAT(std::get<SourceNotice>(notice).error.message(), testing::HasSubstr("lost frames are not counted"));
  EXPECT_TRUE(std::holds_alternative<FramePtr>(source_.next(kLong)));

  send("RGBD_FRAME", frame_bytes(5004));
  EXPECT_TRUE(std::holds_alternative<FramePtr>(source_.next(kLong))) << "said once";
  EXPECT_EQ(source_.counts().lost, 0);
}

TEST_F(LcmLive, AFarJumpLosesNothing) {
  for (const int number : {1, 2, 1'700'000'000, 1'700'000'002}) send("RGBD_FRAME", frame_bytes(number));
  wait_received(4);
  EXPECT_EQ(source_.counts().lost, 1) << "1,700,000,001";
}

TEST_F(LcmLive, WrongTypesAndDamagedMessagesAreSkipped) {
  send("RGBD_FRAME", encode_message(command_t{}));
  EXPECT_TRUE(std::holds_alternative<SkippedFrame>(source_.next(kLong)));
  Bytes cut = frame_bytes(1);
  cut.resize(40);
  send("RGBD_FRAME", cut);
  EXPECT_TRUE(std::holds_alternative<SkippedFrame>(source_.next(kLong)));
  send("RGBD_FRAME", frame_bytes(2));
  EXPECT_TRUE(std::holds_alternative<FramePtr>(source_.next(kLong)));
}

TEST_F(LcmLive, ARepeatedFrameIsSkipped) {
  send("RGBD_FRAME", frame_bytes(2));
  EXPECT_TRUE(std::holds_alternative<FramePtr>(source_.next(kLong)));
  send("RGBD_FRAME", frame_bytes(2));
  EXPECT_TRUE(std::holds_alternative<SkippedFrame>(source_.next(kLong)));
}

TEST_F(LcmLive, AClockThatWasSetBackIsANewStartAndNumbersGoOn) {
  send("RGBD_FRAME", frame_bytes(100));
  EXPECT_EQ(std::get<FramePtr>(source_.next(kLong))->number, 100);
  send("RGBD_FRAME", frame_bytes(1));
  const SourceEvent told = source_.next(kLong);
  EXPECT_NE(std::get<SourceNotice>(told).error.what.find("the time goes back by 3.300 s"), std::string::npos);
  EXPECT_EQ(std::get<FramePtr>(source_.next(kLong))->number, 101);
  send("RGBD_FRAME", frame_bytes(2));
  EXPECT_EQ(std::get<FramePtr>(source_.next(kLong))->number, 102) << "told once";
}

TEST_F(LcmLive, TimesInAnotherUnitAreNamedOnce) {
  int notices = 0, frames = 0;
  for (int i = 0; i < 40; ++i) {
    RgbdFrame frame = test_frame(i);
    frame.utime = 33 * i;
    send("RGBD_FRAME", encode_message(encode_frame(frame, {}).value()));
    SourceEvent event = source_.next(kLong);
    if (const auto* notice = std::get_if<SourceNotice>(&event)) {
      EXPECT_NE(notice->error.what.find("milliseconds"), std::string::npos) << notice->error.what;
      ++notices;
      event = source_.next(kLong);
    }
    frames += std::holds_alternative<FramePtr>(event);
  }
  EXPECT_EQ(notices, 1);
  EXPECT_EQ(frames, 40);
}

TEST_F(LcmLive, DamagedColourCostsNoDepth) {
  rgbd_frame_t message = encode_frame(test_frame(1), {}).value();
  message.colour.resize(20);
  message.colour_size = 20;
  send("RGBD_FRAME", encode_message(message));
  const FramePtr frame = std::get<FramePtr>(source_.next(kLong));
  EXPECT_TRUE(frame->colour.empty());
  EXPECT_NE(frame->colour_fault, "");
}

TEST_F(LcmLive, OtherChannelsAreNotHeard) {
  send("HAND_STATE", encode_message(command_t{}));
  send("RGBD_FRAME", frame_bytes(1));
  EXPECT_TRUE(std::holds_alternative<FramePtr>(source_.next(kLong)));
  EXPECT_EQ(source_.counts().received, 1);
}

TEST_F(LcmLive, StaysWithTheFirstChannelThatBringsAFrameAndTellsOfOthersOnce) {
  send("BAD_RGBD_FRAME", encode_message(command_t{}));
  EXPECT_TRUE(std::holds_alternative<SkippedFrame>(source_.next(kLong)));
  send("LEFT_RGBD_FRAME", frame_bytes(1));
  EXPECT_TRUE(std::holds_alternative<FramePtr>(source_.next(kLong)));
  for (const int number : {1, 2}) {
    send("RIGHT_RGBD_FRAME", frame_bytes(10 * number));
    send("LEFT_RGBD_FRAME", frame_bytes(number + 1));
    wait_received(2 + number);
    SourceEvent event = source_.next(kLong);
    if (number == 1) {
      const Error& told = std::get<SourceNotice>(event).error;
      EXPECT_NE(told.what.find("RIGHT_RGBD_FRAME"), std::string::npos);
      EXPECT_NE(told.where.find("LEFT_RGBD_FRAME"), std::string::npos);
      event = source_.next(kLong);
    }
    EXPECT_EQ(std::get<FramePtr>(event)->number, number + 1);
  }
  EXPECT_EQ(source_.counts().received, 4);
  EXPECT_EQ(source_.counts().replaced, 0);
}

TEST_F(LcmLive, TellsOnceOfTwoSensorsOnOneChannel) {
  int told = 0;
  for (const int number : {1, 2, 3, 4}) {
    send("RGBD_FRAME", encode_message(encode_frame(test_frame(number, number % 2 ? 40 : 20), {}).value()));
    SourceEvent event = source_.next(kLong);
    if (const auto* notice = std::get_if<SourceNotice>(&event)) {
      ++told;
      EXPECT_NE(notice->error.what.find("20x30"), std::string::npos) << notice->error.message();
      event = source_.next(kLong);
    }
    EXPECT_TRUE(std::holds_alternative<FramePtr>(event)) << number;
  }
  EXPECT_EQ(told, 1);
}

TEST_F(LcmLive, WhatOtherChannelsLeftInTheInboxIsLeftOut) {
  const std::shared_ptr<LcmBus> bus = LcmBus::open("memq://").value();
  LcmLiveSource source(bus, {.capacity = 3});
  int number = 1;
  for (const char* channel : {"LEFT_RGBD_FRAME", "RIGHT_RGBD_FRAME", "LEFT_RGBD_FRAME"})
    ASSERT_TRUE(bus->send(channel, frame_bytes(number++), 0));
  while (source.counts().received < 3) std::this_thread::yield();
  EXPECT_EQ(std::get<FramePtr>(source.next(kLong))->number, 1);
  EXPECT_TRUE(std::holds_alternative<SourceNotice>(source.next(kLong)));
  EXPECT_EQ(std::get<FramePtr>(source.next(kLong))->number, 3);
  EXPECT_EQ(source.counts().received, 2);
}

TEST_F(LcmLive, OfAPatternTheFirstChannelWithAFrameIsTaken) {
  const std::shared_ptr<LcmBus> bus = LcmBus::open("memq://").value();
  LcmLiveSource source(bus, {.channel = "CAM*", .capacity = 2});
  EXPECT_EQ(source.name(), "lcm:memq:// CAM*");
  ASSERT_TRUE(bus->send("CAM1", frame_bytes(1), 0));
  EXPECT_TRUE(std::holds_alternative<FramePtr>(source.next(kLong)));
  ASSERT_TRUE(bus->send("CAM2", frame_bytes(2), 0));
  EXPECT_TRUE(std::holds_alternative<SourceNotice>(source.next(kLong)));
}

TEST_F(LcmLive, AChannelsNameIsItselfWhateverIsInIt) {
  for (const char* name : {"cam[0]_F", "left cam F", "/depth(1)+F",
                           "gr\xc3\xb6\xc3\x9f"
                           "eF",
                           "a?b*F", "{$}^|.F", "a\\F"}) {
    const std::shared_ptr<LcmBus> bus = LcmBus::open("memq://").value();
    LcmLiveSource source(bus, {.channel = name});
    ASSERT_TRUE(bus->send("other", frame_bytes(1), 0));
    ASSERT_TRUE(bus->send(name, frame_bytes(2), 0));
    const SourceEvent event = source.next(kLong);
    const auto* frame = std::get_if<FramePtr>(&event);
    ASSERT_TRUE(frame) << name;
    EXPECT_EQ((*frame)->number, 2) << name;
  }
}

TEST_F(LcmLive, AChannelThatLcmCannotListenToIsAnError) {
  const auto source = LcmLiveSource::open("memq://", {.channel = "mess\xfcng"});
  ASSERT_FALSE(source);
  EXPECT_NE(source.error().message().find("not UTF-8"), std::string::npos);
}

TEST(Glob, MatchesNames) {
  for (const auto& [glob, name] : {std::pair("*", ""),
                                   std::pair("*", "A"),
                                   {"A*C", "ABBC"},
                                   {"A*C", "ACC"},
                                   {"?B", "AB"},
                                   {"**_F", "A_F"},
                                   {"*A*B", "xAyAzB"},
                                   {"[1]", "[1]"},
                                   {"a\\*", "a\\b"}})
    EXPECT_TRUE(matches_glob(glob, name)) << glob;
  for (const auto& [glob, name] :
       {std::pair("", "A"), std::pair("A", ""), {"A*C", "ABB"}, {"?", ""}, {"A", "AB"}, {"[12]", "1"}, {"*A", "AB"}})
    EXPECT_FALSE(matches_glob(glob, name)) << glob;
}

TEST(Glob, BecomesARegularExpression) {
  EXPECT_EQ(glob_to_regex("*RGBD_FRAME"), ".*RGBD_FRAME");
  EXPECT_EQ(glob_to_regex("A.B?(C)"), "A\\.B.\\(C\\)");
}

TEST(LcmBus, AnUnknownUrlIsAnErrorThatShowsGoodOnes) {
  const auto bus = LcmBus::open("nonsense://x");
  ASSERT_FALSE(bus);
  EXPECT_NE(bus.error().message().find("udpm://"), std::string::npos);
}

TEST(LcmBus, MessagesThatLcmCannotCarryAreErrors) {
  auto bus = LcmBus::open("memq://").value();
  EXPECT_FALSE(bus->send(std::string(64, 'A'), Bytes(3), 0));
  EXPECT_FALSE(bus->send("A", Bytes(5u << 20), 0));
  EXPECT_TRUE(bus->send(std::string(63, 'A'), Bytes(3), 0));
}

}  // namespace
}  // namespace barehand
