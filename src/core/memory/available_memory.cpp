// The memory that this process may still use, within the limits of its control groups.
#include "core/memory/available_memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace barehand {
namespace {

/// Path of this process's control group (version 2), for example "/system.slice/barehand.service"; "" if there is none.
std::string group_path(const std::string& own_group) {
  std::ifstream lines(own_group);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("0::/")) return line.substr(3);
  return {};
}

}  // namespace

std::int64_t available_memory(const std::string& meminfo, const std::string& own_group, const std::string& groups) {
  // Read how much memory the kernel considers available.
  std::int64_t bytes = std::numeric_limits<std::int64_t>::max();
  std::ifstream info(meminfo);
  for (std::string key; info >> key; info.ignore(1024, '\n'))
    if (std::int64_t kilobytes = 0; key == "MemAvailable:" && info >> kilobytes) bytes = kilobytes * 1024;

  // Apply the limits of the control group and of all groups above it.
  for (std::string group = group_path(own_group);; group.resize(group.rfind('/'))) {
    // A group without a limit has "max" in place of a number.
    if (std::int64_t limit = 0; std::ifstream(groups + group + "/memory.max") >> limit) bytes = std::min(bytes, limit);
    if (group.find('/') == std::string::npos) break;
  }

  // Apply the limit of the address space (ulimit -v).
  if (rlimit limit{}; getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    bytes = std::min(bytes, static_cast<std::int64_t>(limit.rlim_cur));
  return bytes;
}

}  // namespace barehand
