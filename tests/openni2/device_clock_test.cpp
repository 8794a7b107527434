#include "drivers/openni2/frames/device_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace barehand {
namespace {

constexpr std::int64_t kPeriod = 33'333;
constexpr std::int64_t kHostStart = 900'000'000;  // the two clocks are unrelated
constexpr std::int64_t kLeastDelay = 8'000;

/// A sensor whose frames arrive late by a minimum delay plus a random one.
class Sensor {
 public:
  Sensor(double drift_ppm, std::int64_t most_jitter_us) : drift_(1 + 1e-6 * drift_ppm), jitter_(0, most_jitter_us) {}

  /// Error of the next frame's time [us], without the minimum delay.
  std::int64_t next(std::int64_t extra_delay = 0) {
    exposed_ += kPeriod;
    const std::int64_t arrival = kHostStart + exposed_ + kLeastDelay + jitter_(random_) + extra_delay;
    last_ = clock.map(offset + std::llround(static_cast<double>(exposed_) * drift_), arrival);
    EXPECT_LE(last_.host_us, arrival);
    EXPECT_GT(last_.host_us, before_);
    before_ = last_.host_us;
    return last_.host_us - (kHostStart + exposed_ + kLeastDelay);
  }
  void run(double seconds) {
    for (std::int64_t end = exposed_ + std::llround(1e6 * seconds); exposed_ < end;) {
      next();
      EXPECT_FALSE(jumped()) << exposed_;
    }
  }
  std::optional<std::int64_t> jumped() const { return last_.jumped_by; }

  DeviceClock clock;
  std::int64_t offset = 123'456;

 private:
  double drift_;
  std::uniform_int_distribution<std::int64_t> jitter_;
  std::mt19937 random_{7};
  std::int64_t exposed_ = 0, before_ = 0;
  DeviceClock::Mapped last_;
};

TEST(DeviceClock, JitterOfTheArrivalDoesNotReachTheStamps) {
  Sensor sensor(0, 12'000);
  sensor.run(10);
  for (int i = 0; i < 300; ++i) EXPECT_NEAR(sensor.next(), 0, 1500);
}

class Drift : public ::testing::TestWithParam<double> {};
TEST_P(Drift, IsEstimated) {
  Sensor sensor(GetParam(), 6'000);
  sensor.run(120);
  EXPECT_NEAR(sensor.clock.drift_ppm(), GetParam(), 15);
  for (int i = 0; i < 300; ++i) EXPECT_NEAR(sensor.next(), 0, 1500);
}
INSTANTIATE_TEST_SUITE_P(Ppm, Drift, ::testing::Values(-300.0, -40.0, 0.0, 75.0, 500.0));

TEST(DeviceClock, AFrameHeldUpOnItsWayKeepsItsTime) {
  Sensor sensor(50, 2'000);
  sensor.run(30);
  EXPECT_NEAR(sensor.next(1'500'000), 0, 1000);
  EXPECT_FALSE(sensor.jumped());
}

class Jump : public ::testing::TestWithParam<std::int64_t> {};
TEST_P(Jump, IsToldAndFollowed) {
  Sensor sensor(0, 2'000);
  sensor.run(20);
  sensor.offset += GetParam();
  sensor.next();
  ASSERT_TRUE(sensor.jumped());
  EXPECT_NEAR(static_cast<double>(*sensor.jumped()), static_cast<double>(GetParam()), 5'000);
  sensor.run(5);
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(sensor.next(), 0, 2'500);
}
INSTANTIATE_TEST_SUITE_P(Microseconds, Jump,
                         ::testing::Values(-3'600'000'000, -5'000'000, -100'000, 120'000, 5'000'000, 3'600'000'000));

TEST(DeviceClock, AClockThatFallsBehindForGoodIsFollowed) {
  Sensor sensor(0, 2'000);
  sensor.run(20);
  int frames = 0;
  while (!sensor.jumped() && ++frames < 300) sensor.next(200'000);  // from now on every frame arrives later
  EXPECT_GT(frames, 30);  // a few late frames are no reason to restart the clock
  ASSERT_LT(frames, 150);
  EXPECT_NEAR(sensor.next(200'000), 200'000, 3'000);
}

TEST(DeviceClock, AClockThatStandsStillGivesTheArrivalTimes) {
  DeviceClock clock;
  clock.map(0, 1'000);
  EXPECT_EQ(clock.map(0, 34'000).host_us, 34'000);
  EXPECT_EQ(clock.map(0, 67'000).host_us, 67'000);
}

}  // namespace
}  // namespace barehand
