#include "core/process_usage.h"

#include <gtest/gtest.h>

#include <vector>

namespace barehand {
namespace {

TEST(ProcessUsage, ComputingTakesCpuSeconds) {
  const double before = cpu_seconds();
  volatile double sum = 0;
  while (cpu_seconds() < before + 0.02) sum = sum + 1;
  EXPECT_GE(cpu_seconds() - before, 0.02);
}

TEST(ProcessUsage, PeakKeepsWhatWasReleased) {
  constexpr std::int64_t kBlock = 64 << 20;
  if (!reset_peak_memory()) GTEST_SKIP() << "/proc/self/clear_refs cannot be written";
  const MemoryUsage before = memory_usage();
  { const std::vector<char> block(kBlock, 1); }
  const MemoryUsage after = memory_usage();
  EXPECT_GE(after.peak, before.resident + kBlock * 9 / 10);
  EXPECT_LT(after.resident, before.resident + kBlock / 2);
  ASSERT_TRUE(reset_peak_memory());
  EXPECT_LT(memory_usage().peak, before.resident + kBlock / 2);
}

}  // namespace
}  // namespace barehand
