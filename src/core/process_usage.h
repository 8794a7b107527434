#pragma once

#include <cstdint>

namespace barehand {

/// CPU seconds of all threads of this process so far, user and system.
double cpu_seconds();

/// Memory of this process that is in RAM [bytes]; 0 where the system does not say (no /proc).
struct MemoryUsage {
  std::int64_t resident = 0;
  std::int64_t peak = 0;  ///< largest `resident` since the start or the last reset_peak_memory()
};
MemoryUsage memory_usage();

/// Starts the peak anew from what is resident now; false where the system does not allow it.
bool reset_peak_memory();

}  // namespace barehand
