#pragma once

#include <cstdint>
#include <string>

namespace barehand {

/// Bytes that this process may still take: what the kernel calls available, within the limits of its control group and
/// of its address space (ulimit -v). The files are as the kernel writes them; one that is missing limits nothing.
std::int64_t available_memory(const std::string& meminfo = "/proc/meminfo",
                              const std::string& cgroup_limit = "/sys/fs/cgroup/memory.max");

}  // namespace barehand
