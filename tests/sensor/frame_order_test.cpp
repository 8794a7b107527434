#include "sensor/frame_order.h"

#include <gmock/gmock.h>

#include <functional>

namespace barehand {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t kFrame = 33'333;  // us
constexpr std::int64_t kNow = 1'700'000'000'000'000;

/// The numbers that FrameOrder gives to frames; "-" if it rejects a frame.
std::string numbers(const std::vector<std::pair<std::int64_t, std::int64_t>>& frames) {
  FrameOrder order(StampUnit::microseconds);
  std::string text;
  for (const auto& [utime, number] : frames) {
    const auto used = order.number(utime, number);
    text += used ? std::to_string(*used) + " " : "- ";
  }
  return text;
}

std::vector<std::string> warnings(StampUnit unit, const std::function<std::int64_t(int)>& utime, int frames = 30) {
  FrameOrder order(unit);
  for (int i = 0; i < frames; ++i) order.number(utime(i), i);
  return order.take_last_warnings();
}

TEST(FrameOrder, FramesThatRepeatOrWereOvertakenAreNotUsed) {
  EXPECT_EQ(numbers({{kNow, 0}, {kNow + 10, 1}, {kNow + 10, 2}, {kNow + 5, 3}, {kNow + 11, 4}}), "0 1 - - 4 ");
  EXPECT_EQ(numbers({{0, 0}, {0, 1}, {-1, 2}, {-999'999, 3}, {1, 4}}), "0 - - - 4 ");
  EXPECT_EQ(numbers({{-3 * kFrame, 0}, {-2 * kFrame, 1}, {-kFrame, 2}, {0, 3}, {kFrame, 4}}), "0 1 2 3 4 ")
      << "before 0 is a time like others";
}

TEST(FrameOrder, EqualTimesAreExplained) {
  FrameOrder order(StampUnit::microseconds);
  order.number(kNow, 0);
  EXPECT_THAT(order.number(kNow, 1).error().message(), HasSubstr("a time of its own"));
  EXPECT_THAT(order.number(kNow - 1, 2).error().message(), testing::Not(HasSubstr("its own")));
}

TEST(FrameOrder, ASecondBackIsANewStart) {
  EXPECT_EQ(numbers({{kNow, 0}, {kNow + kFrame, 1}, {kNow - 1'000'000, 2}, {kNow - 1'000'000 + kFrame, 3}}),
            "0 1 2 3 ");
  EXPECT_EQ(numbers({{kNow, 0}, {0, 1}, {kFrame, 2}}), "0 1 2 ");
}

TEST(FrameOrder, NumbersGoOnWhereTheSenderCountsAnew) {
  EXPECT_EQ(numbers({{0, 0}, {1, 1}, {2, 2}, {60'000'000, 0}, {60'000'001, 1}, {60'000'002, 3}}), "0 1 2 3 4 6 ");
  EXPECT_EQ(numbers({{10'000'000, 500}, {10'000'001, 501}, {0, 0}, {1, 1}}), "500 501 502 503 ") << "with its clock";
  EXPECT_EQ(numbers({{0, 0}, {1, 1}, {2, 0}, {3, 1}, {4, 0}, {5, 1}}), "0 1 2 3 4 5 ") << "again and again";
  EXPECT_EQ(numbers({{0, 7}, {1, 7}, {2, 7}}), "7 8 9 ") << "one that does not count";
  EXPECT_EQ(numbers({{0, 0}, {1, 1'000}, {2, 5}, {3, 6}}), "0 1000 1001 1002 ");
}

TEST(FrameOrder, NumbersBeyondAllMeasureDoNotOverflow) {
  EXPECT_EQ(numbers({{0, INT64_MAX}, {1, INT64_MIN}, {2, 5}, {3, INT64_MAX}, {4, 0}}),
            "9223372036854775807 -9223372036854775808 5 9223372036854775807 0 ");
}

TEST(FrameOrder, WhatCannotBeATimeIsNotUsedAndSaysWhatItLooksLike) {
  FrameOrder order(StampUnit::microseconds);
  const auto ns = order.number(1'700'000'000'000'000'000, 0);
  ASSERT_FALSE(ns);
  EXPECT_THAT(ns.error().message(), AllOf(HasSubstr("nanoseconds since the epoch"), HasSubstr("divide it by 1000")));
  EXPECT_FALSE(order.number(INT64_MIN, 0));
  EXPECT_FALSE(order.number(INT64_MAX, 0));
  EXPECT_TRUE(order.number(kNow, 0)) << "what was not used counts for nothing";
  EXPECT_THAT(too_late(1.7e12, StampUnit::seconds), AllOf(HasSubstr("milliseconds"), HasSubstr("divide it by 1000")));
  EXPECT_THAT(too_late(1.7e15, StampUnit::seconds), AllOf(HasSubstr("microseconds"), HasSubstr("by 1000000")));
  EXPECT_THAT(too_late(1.7e18, StampUnit::seconds), HasSubstr("nanoseconds"));
  EXPECT_THAT(too_late(1e300, StampUnit::seconds), HasSubstr("no recording is from that time"));
}

TEST(FrameOrder, RecordingsAtUsualRatesRaiseNoDoubt) {
  for (const std::int64_t step : {1'000, 11'111, 16'667, 33'333, 66'667, 83'333, 200'000, 500'000, 1'500'000})
    for (const StampUnit unit : {StampUnit::seconds, StampUnit::microseconds})
      EXPECT_THAT(warnings(unit, [&](int i) { return kNow + step * i; }), IsEmpty()) << step;
  EXPECT_THAT(warnings(StampUnit::seconds, [](int i) { return i * kFrame + (i > 15 ? 600'000'000 : 0); }), IsEmpty())
      << "a pause of ten minutes";
  EXPECT_THAT(warnings(
                  StampUnit::seconds, [](int) { return kNow; }, 1),
              IsEmpty());
  EXPECT_THAT(warnings(StampUnit::seconds, [](int i) { return kNow + 500'000 + i * 1'000'000LL; }), IsEmpty())
      << "one frame a second, at half seconds";
}

TEST(FrameOrder, OtherUnitsThanSecondsAreNamed) {
  const auto said = [](double factor, int frames = 30) {
    return warnings(
        StampUnit::seconds, [&](int i) { return std::llround(1e6 * factor * (5 + i / 30.0)); }, frames);
  };
  EXPECT_THAT(said(1e3), ElementsAre(AllOf(HasSubstr("33.33"), HasSubstr("milliseconds: divide them by 1e3"))));
  EXPECT_THAT(said(1e6), ElementsAre(HasSubstr("microseconds: divide them by 1e6")));
  EXPECT_THAT(said(1e9), ElementsAre(HasSubstr("nanoseconds: divide them by 1e9")));
  EXPECT_THAT(said(30), ElementsAre(HasSubstr("frame numbers"))) << "ICL-NUIM";
  EXPECT_THAT(said(1e3, 3), ElementsAre(HasSubstr("milliseconds"))) << "a short recording";
  EXPECT_THAT(said(1e-3), ElementsAre(HasSubstr("another unit")));
}

TEST(FrameOrder, OtherUnitsThanMicrosecondsAreNamed) {
  const auto said = [](double factor) {
    return warnings(StampUnit::microseconds, [&](int i) { return std::llround(1e6 * factor * (5 + i / 30.0)); });
  };
  EXPECT_THAT(said(1e3), ElementsAre(HasSubstr("nanoseconds: divide them by 1e3")));
  EXPECT_THAT(said(1e-3), ElementsAre(HasSubstr("milliseconds: multiply them by 1000")));
  EXPECT_THAT(said(30e-6), ElementsAre(HasSubstr("frame numbers")));
}

TEST(FrameOrder, ACounterThatOverflowsIsNamed) {
  const auto wraps_at = [](std::int64_t range) {
    return warnings(StampUnit::microseconds, [=](int i) { return (range - 10 * kFrame + i * kFrame) % range; });
  };
  EXPECT_THAT(wraps_at(1LL << 32), ElementsAre(AllOf(HasSubstr("frame 10"), HasSubstr("microseconds with 32 bits"))));
  EXPECT_THAT(wraps_at(1000 * (1LL << 32)), ElementsAre(HasSubstr("milliseconds with 32 bits")));
  EXPECT_THAT(wraps_at(100'000'000), ElementsAre(AllOf(HasSubstr("back by 99.967 s"), HasSubstr("new start"))));
}

TEST(FrameOrder, EachThingIsSaidOnce) {
  FrameOrder order(StampUnit::seconds);
  int said = 0;
  for (int i = 0; i < 200; ++i) {
    order.number(i % 20 * 33'000'000LL, i);
    said += static_cast<int>(order.take_warnings().size());
  }
  EXPECT_EQ(said, 2) << "milliseconds, and a time that goes back";
  EXPECT_THAT(order.take_last_warnings(), IsEmpty());
}

TEST(FrameOrder, ManyFramesOutOfOrderAreCounted) {
  EXPECT_THAT(warnings(StampUnit::seconds, [](int i) { return (i % 2 ? 0 : 50'000) + i * 20'000; }),
              ElementsAre(AllOf(HasSubstr("15 of 30 frames"), HasSubstr("in order of time?"))));
}

}  // namespace
}  // namespace barehand
