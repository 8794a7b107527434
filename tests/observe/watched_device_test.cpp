#include "observe/sampled/watched_device.h"

#include <gmock/gmock.h>

#include "tests/observe/timed_observers.h"

namespace barehand {
namespace {

constexpr double kCpuSeconds = 1e-6;  // per sample
constexpr int kPerSegment = 100;      // the CPU takes 1.6 ms for all segments
constexpr int kLongRun = 10'000;      // number of calls in some minutes of tracking

/// The number of calls that succeed before the device is given up, at most kLongRun.
int good_calls(std::deque<std::int64_t> call_us, int per_segment = kPerSegment) {
  const auto clock = std::make_shared<ManualClock>();
  WatchedDevice device(std::make_unique<TimedDevice>(Stopwatch(clock, std::move(call_us))), kCpuSeconds, clock);
  const EmptyBatch batch(per_segment);
  PatchDistances distances;
  int good = 0;
  while (good < kLongRun && device.compare(batch.batch(), distances)) ++good;
  return good;
}

std::deque<std::int64_t> fast_calls(int count, std::int64_t us = 200) { return std::deque<std::int64_t>(count, us); }

TEST(WatchedDevice, IsKeptWhileItIsFaster) {
  EXPECT_EQ(good_calls({200}), kLongRun);
  EXPECT_EQ(good_calls({1600}), kLongRun);
}

TEST(WatchedDevice, FailsWhereItIsSlowerForLong) {
  EXPECT_EQ(good_calls({35'000}), 14);         // 33.4 ms lost in each call
  EXPECT_NEAR(good_calls({1'700}), 5'000, 2);  // 0.1 ms
}

TEST(WatchedDevice, LaterSlownessIsNoticedAsSoonAsEarlierOne) {
  auto calls = fast_calls(1000);
  calls.push_back(35'000);
  EXPECT_EQ(good_calls(calls), 1014);
}

TEST(WatchedDevice, SlowCallsNowAndThenAreForgivenWhereTheOthersMakeUpForThem) {
  const auto clock = std::make_shared<ManualClock>();
  std::deque<std::int64_t> calls;
  for (int i = 0; i < 100; ++i) {
    calls.push_back(35'000);  // loses 33.4 ms, which 24 calls that gain 1.4 ms pay back
    for (const std::int64_t us : fast_calls(24)) calls.push_back(us);
  }
  calls.push_back(200);
  EXPECT_EQ(good_calls(calls), kLongRun);
}

TEST(WatchedDevice, IsHeldAgainstWhatTheCpuTakesForTheBatch) {
  EXPECT_EQ(good_calls({3'000}, 200), kLongRun);
  EXPECT_LT(good_calls({3'000}, 100), kLongRun);
}

TEST(WatchedDevice, ErrorSaysHowSlowItIs) {
  const auto clock = std::make_shared<ManualClock>();
  WatchedDevice device(std::make_unique<TimedDevice>(Stopwatch(clock, {900'000})), kCpuSeconds, clock);
  const EmptyBatch batch(kPerSegment);
  PatchDistances distances;
  const auto done = device.compare(batch.batch(), distances);
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message(), ::testing::HasSubstr("900.00 ms instead of 1.60 ms"));
}

TEST(WatchedDevice, ErrorsOfTheDevicePassThrough) {
  const auto clock = std::make_shared<ManualClock>();
  WatchedDevice device(std::make_unique<TimedDevice>(Stopwatch(clock, {100}), 0), kCpuSeconds, clock);
  const EmptyBatch batch(kPerSegment);
  PatchDistances distances;
  const auto done = device.compare(batch.batch(), distances);
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message(), ::testing::HasSubstr("gone"));
}

}  // namespace
}  // namespace barehand
