// Measures the calls of a pipeline stage and counts its failures.
#include "core/stage_monitor.h"

#include <exception>

namespace barehand {

StageHealth StageMonitor::health() const {
  std::unique_lock lock(mutex_);
  return {name_, total_.summary(), failed_};
}

StageHealth StageMonitor::take_interval() {
  std::unique_lock lock(mutex_);
  StageHealth health{name_, interval_.summary(), failed_};
  interval_.clear();
  return health;
}

int StageMonitor::failures_in_a_row() const {
  std::unique_lock lock(mutex_);
  return failures_in_a_row_;
}

tl::unexpected<Error> StageMonitor::thrown() const {
  try {
    throw;
  } catch (const std::exception& e) {
    return fail(std::string("threw: ") + e.what(), name_);
  } catch (...) {
    return fail("threw an object that is not a std::exception", name_);
  }
}

void StageMonitor::record(std::int64_t duration_us, bool ok) {
  std::unique_lock lock(mutex_);
  total_.add(duration_us);
  interval_.add(duration_us);
  if (!ok) ++failed_;
  failures_in_a_row_ = ok ? 0 : failures_in_a_row_ + 1;
}

}  // namespace barehand
