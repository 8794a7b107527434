#include "observe/sampled/comparison_times.h"

#include <gmock/gmock.h>

#include "tests/observe/timed_observers.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;

class ComparisonTimesOf : public ::testing::Test {
 protected:
  Result<ComparisonTimes> times(std::deque<std::int64_t> cpu_us, std::deque<std::int64_t> device_us, int failing = -1) {
    TimedCpu cpu({clock_, std::move(cpu_us)});
    TimedDevice device({clock_, std::move(device_us)}, failing, &map_ids_);
    return time_comparison(batch_.batch(7), cpu, device, *clock_, distances_);
  }
  std::shared_ptr<ManualClock> clock_ = std::make_shared<ManualClock>();
  EmptyBatch batch_{10};
  PatchDistances distances_;
  std::vector<std::uint64_t> map_ids_;
};

TEST_F(ComparisonTimesOf, AreMediansWithoutTheFirstCall) {
  const auto found =
      times({900'000, 300, 5'000, 310, 290, 300, 280, 320}, {700'000, 90, 80, 100, 40'000, 110, 70, 100});
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->cpu, 300e-6);
  EXPECT_DOUBLE_EQ(found->device, 100e-6);
}

TEST_F(ComparisonTimesOf, EveryCallBringsTheDeviceAMapAndTheLastOneIsTheBatchs) {
  ASSERT_TRUE(times({300}, {100}));
  ASSERT_GT(map_ids_.size(), 2u);
  for (std::size_t i = 1; i < map_ids_.size(); ++i) EXPECT_NE(map_ids_[i], map_ids_[i - 1]);
  EXPECT_EQ(map_ids_.back(), 7u);
}

TEST_F(ComparisonTimesOf, DistancesAreTheCpus) {
  ASSERT_TRUE(times({300}, {100}));
  EXPECT_EQ(distances_[3][4].distance, kByCpu);
  for (const int failing : {0, 3}) {
    const auto found = times({300}, {100}, failing);
    ASSERT_FALSE(found);
    EXPECT_THAT(found.error().message(), HasSubstr("gone"));
    EXPECT_EQ(distances_[3][4].distance, kByCpu);
  }
}

TEST_F(ComparisonTimesOf, TextSaysWhichIsFasterAndByHowMuch) {
  EXPECT_EQ(to_text({0.29e-3, 0.1e-3}),
            "a call takes 0.29 ms on the CPU and 0.10 ms on the device, which is 2.9 times as fast");
  EXPECT_THAT(to_text({0.29e-3, 35e-3}), HasSubstr("which is 120.7 times as slow"));
}

}  // namespace
}  // namespace barehand
