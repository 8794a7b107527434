// CPU time and memory of this process, as the system reports them.
#include "core/process_usage.h"

#include <sys/resource.h>

#include <fstream>
#include <string>

namespace barehand {
namespace {

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); }

}  // namespace

double cpu_seconds() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

MemoryUsage memory_usage() {
  MemoryUsage usage;
  std::ifstream status("/proc/self/status");
  for (std::string key; status >> key;) {
    if (key == "VmHWM:") status >> usage.peak;
    if (key == "VmRSS:") status >> usage.resident;
    status.ignore(1024, '\n');
  }
  usage.peak *= 1024;
  usage.resident *= 1024;
  return usage;
}

bool reset_peak_memory() {
  std::ofstream clear("/proc/self/clear_refs");
  clear << "5" << std::flush;
  return clear.good();
}

}  // namespace barehand
