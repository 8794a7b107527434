#include "core/available_memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace barehand {

std::int64_t available_memory(const std::string& meminfo, const std::string& cgroup_limit) {
  std::int64_t bytes = std::numeric_limits<std::int64_t>::max();
  std::ifstream info(meminfo);
  for (std::string key; info >> key; info.ignore(1024, '\n'))
    if (std::int64_t kilobytes = 0; key == "MemAvailable:" && info >> kilobytes) bytes = kilobytes * 1024;
  if (std::int64_t limit = 0; std::ifstream(cgroup_limit) >> limit) bytes = std::min(bytes, limit);  // else "max"
  if (rlimit limit{}; getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    bytes = std::min(bytes, static_cast<std::int64_t>(limit.rlim_cur));
  return bytes;
}

}  // namespace barehand
