#include "core/process_usage.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstring>

namespace barehand {
namespace {

TEST(ProcessUsage, ComputingTakesCpuSeconds) {
  const double before = cpu_seconds();
  volatile double sum = 0;
  while (cpu_seconds() < before + 0.02) sum = sum + 1;
  EXPECT_GT(cpu_seconds() - before, 0.019);  // the sum is rounded
}

/// Uses this much memory and unmaps it at once. An allocator might keep it for later.
void fill_and_release(std::size_t bytes) {
  void* const block = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(block, MAP_FAILED);
  std::memset(block, 1, bytes);
  munmap(block, bytes);
}

TEST(ProcessUsage, PeakKeepsWhatWasReleased) {
  constexpr std::int64_t kBlock = 64 << 20;
  if (!reset_peak_memory()) GTEST_SKIP() << "/proc/self/clear_refs cannot be written";
  const MemoryUsage before = memory_usage();
  fill_and_release(kBlock);
  const MemoryUsage after = memory_usage();
  EXPECT_GE(after.peak, before.resident + kBlock * 9 / 10);
  EXPECT_LT(after.resident, before.resident + kBlock / 2);
  ASSERT_TRUE(reset_peak_memory());
  EXPECT_LT(memory_usage().peak, before.resident + kBlock / 2);
}

}  // namespace
}  // namespace barehand
