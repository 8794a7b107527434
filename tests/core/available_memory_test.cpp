#include "core/memory/available_memory.h"

#include <gtest/gtest.h>

#include "support/temp_folder.h"

namespace barehand {
namespace {

TEST(AvailableMemory, IsTheKernelsFigureWithinTheGroupsLimit) {
  // Stand-ins for /proc/meminfo, /proc/self/cgroup and the files of the control groups.
  const test::TempFolder folder;
  const std::string info = folder / "meminfo", own = folder / "cgroup";
  const std::string service = folder / "system.slice/barehand.service";
  std::filesystem::create_directories(service);

  // Without a control group, MemAvailable counts.
  test::write_text(info, "MemTotal:  8000 kB\nMemFree:  1000 kB\nMemAvailable:  3000 kB\n");
  EXPECT_EQ(available_memory(info, "/nonexistent", "/nonexistent"), 3000 * 1024);

  // The lowest limit of the group and of its parents counts.
  test::write_text(own, "4:memory:/elsewhere\n0::/system.slice/barehand.service\n");
  test::write_text(service + "/memory.max", "max\n");
  EXPECT_EQ(available_memory(info, own, folder.path()), 3000 * 1024);
  test::write_text(service + "/memory.max", "2097152\n");
  EXPECT_EQ(available_memory(info, own, folder.path()), 2097152);
  test::write_text(folder / "system.slice/memory.max", "1048576\n");
  EXPECT_EQ(available_memory(info, own, folder.path()), 1048576);
  test::write_text(folder / "memory.max", "524288\n");
  EXPECT_EQ(available_memory(info, own, folder.path()), 524288);

  // In a control-group namespace, the process's group appears as the root.
  test::write_text(own, "0::/\n");
  EXPECT_EQ(available_memory(info, own, folder.path()), 524288);
}

}  // namespace
}  // namespace barehand
