#pragma once

#include <cstdint>
#include <string>

namespace barehand {

/// Memory that this process may still allocate [bytes]: what the kernel calls available, limited by the process's
/// control group and its parents (version 2) and by its address space (ulimit -v). The arguments are paths of files in
/// the kernel's format; a missing file imposes no limit.
std::int64_t available_memory(const std::string& meminfo = "/proc/meminfo",
                              const std::string& own_group = "/proc/self/cgroup",
                              const std::string& groups = "/sys/fs/cgroup");

}  // namespace barehand
