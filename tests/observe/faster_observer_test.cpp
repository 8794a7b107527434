#include "observe/sampled/faster_observer.h"

#include <gmock/gmock.h>

#include <sstream>

#include "support/text_logger.h"
#include "tests/observe/timed_observers.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Faster : public ::testing::Test {
 protected:
  std::unique_ptr<FasterObserver> observer(std::deque<std::int64_t> cpu_us, std::deque<std::int64_t> device_us,
                                           int failing = -1) {
    return std::make_unique<FasterObserver>(
        std::make_unique<TimedDevice>(Stopwatch(clock_, std::move(device_us)), failing), "Card 9",
        std::make_unique<TimedCpu>(Stopwatch(clock_, std::move(cpu_us))), test::text_logger(log_), clock_);
  }
  /// Compares a batch; returns which observer did it (kByCpu or kByDevice).
  float who(FasterObserver& observer) {
    PatchDistances distances;
    observer.compare(batch_.batch(), distances);
    return distances[3][4].distance;
  }
  std::shared_ptr<ManualClock> clock_ = std::make_shared<ManualClock>();
  std::ostringstream log_;
  EmptyBatch batch_{10};
};

TEST_F(Faster, FirstBatchIsTheCpusAndLaterOnesTheFasterOnes) {
  const auto observer = this->observer({1'000}, {400});
  EXPECT_FALSE(observer->on_device());
  EXPECT_EQ(who(*observer), kByCpu);
  EXPECT_THAT(log_.str(),
              HasSubstr("samples are compared on Card 9: a call takes 1.00 ms on the CPU and 0.40 ms on the "
                        "device, which is 2.5 times as fast (160 samples)"));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(who(*observer), kByDevice);
  EXPECT_TRUE(observer->on_device());
}

TEST_F(Faster, SlowerDeviceIsNeverUsed) {
  for (const std::int64_t device_us : {1'000, 35'000}) {
    const auto observer = this->observer({1'000}, {device_us});
    for (int i = 0; i < 4; ++i) EXPECT_EQ(who(*observer), kByCpu) << device_us;
    EXPECT_FALSE(observer->on_device());
  }
  EXPECT_THAT(log_.str(), HasSubstr("samples are compared on the CPU, not on Card 9: "));
  EXPECT_THAT(log_.str(), HasSubstr("35.0 times as slow"));
  EXPECT_THAT(log_.str(), Not(HasSubstr("[warning]")));
}

TEST_F(Faster, DeviceThatStartsSlowlyIsChosenAllTheSame) {
  const auto observer = this->observer({1'000}, {300'000, 400});
  who(*observer);
  EXPECT_EQ(who(*observer), kByDevice);
}

TEST_F(Faster, DeviceThatFailsWhileMeasuredIsNotUsed) {
  for (const int failing : {0, 4}) {
    const auto observer = this->observer({1'000}, {400}, failing);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(who(*observer), kByCpu);
    EXPECT_THAT(log_.str(), HasSubstr("[warning] samples are compared on the CPU, not on Card 9: device: gone"));
  }
}

TEST_F(Faster, DeviceThatFailsLaterLeavesItsBatchToTheCpu) {
  const auto observer = this->observer({1'000}, {400}, 9);  // 8 while measured
  who(*observer);
  EXPECT_EQ(who(*observer), kByDevice);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(who(*observer), kByCpu);
  EXPECT_FALSE(observer->on_device());
  EXPECT_THAT(log_.str(), HasSubstr("samples are compared on the CPU from now on, not on the GPU: device: gone"));
}

TEST_F(Faster, DeviceThatTurnsSlowLeavesItsBatchToTheCpu) {
  std::deque<std::int64_t> calls(20, 400);
  calls.push_back(102'000);  // loses 101 ms in each call
  const auto observer = this->observer({1'000}, std::move(calls));
  who(*observer);
  for (int i = 0; i < 16; ++i) EXPECT_EQ(who(*observer), kByDevice) << i;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(who(*observer), kByCpu);
  EXPECT_FALSE(observer->on_device());
  EXPECT_THAT(log_.str(), HasSubstr("it became slower than the CPU, the last call with 102.00 ms instead of 1.00 ms"));
}

}  // namespace
}  // namespace barehand
