#pragma once

#include <cstdint>

namespace barehand {

/// CPU time of all threads of this process so far, user and system [s].
double cpu_seconds();

/// Resident memory of this process [bytes]; 0 where the system does not provide it (no /proc).
struct MemoryUsage {
  std::int64_t resident = 0;
  std::int64_t peak = 0;  ///< largest `resident` since the start or the last reset_peak_memory()
};
/// Returns this process's current memory usage.
MemoryUsage memory_usage();

/// Sets the peak to the present resident memory. Returns false if the system does not allow it.
bool reset_peak_memory();

}  // namespace barehand
