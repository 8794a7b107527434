#pragma once

#include <cstdint>
#include <string>

namespace barehand {

/// Bytes that this process may still take: what the kernel calls available, within the limits of its control group and
/// those above it (version 2), and of its address space (ulimit -v). The files are as the kernel writes them; one that
/// is missing limits nothing.
std::int64_t available_memory(const std::string& meminfo = "/proc/meminfo",
                              const std::string& own_group = "/proc/self/cgroup",
                              const std::string& groups = "/sys/fs/cgroup");

}  // namespace barehand
