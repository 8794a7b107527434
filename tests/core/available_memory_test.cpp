#include "core/available_memory.h"

#include <gtest/gtest.h>

#include "support/temp_folder.h"

namespace barehand {
namespace {

TEST(AvailableMemory, IsTheKernelsFigureWithinTheGroupsLimit) {
  const test::TempFolder folder;
  const std::string info = folder / "meminfo", limit = folder / "memory.max";
  test::write_text(info, "MemTotal:  8000 kB\nMemFree:  1000 kB\nMemAvailable:  3000 kB\n");
  EXPECT_EQ(available_memory(info, "/nonexistent"), 3000 * 1024);
  test::write_text(limit, "max\n");
  EXPECT_EQ(available_memory(info, limit), 3000 * 1024);
  test::write_text(limit, "2097152\n");
  EXPECT_EQ(available_memory(info, limit), 2097152);
}

}  // namespace
}  // namespace barehand
