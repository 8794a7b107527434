#pragma once

#include <exception>
#include <mutex>
#include <string>
#include <utility>

#include "core/clock.h"
#include "core/error.h"
#include "core/statistics.h"

namespace barehand {

/// Wraps the calls of one stage: measures their time, turns exceptions into errors and counts failures. One thread
/// runs the stage; any thread may ask for its health.
class StageMonitor {
 public:
  StageMonitor(std::string name, const Clock& clock) : name_(std::move(name)), clock_(clock) {}

  /// Runs fn() -> Result<T>, timed and counted.
  template <typename Fn>
  auto run(Fn&& fn) -> decltype(fn()) {
    const std::int64_t start = clock_.steady_us();
    auto result = guarded(std::forward<Fn>(fn));
    record(clock_.steady_us() - start, result.has_value());
    return result;
  }

  /// Times and failures since the start of the run.
  StageHealth health() const;
  /// Times since the last call of this function; failures since the start of the run.
  StageHealth take_interval();
  /// Number of failures since the last success.
  int failures_in_a_row() const;
  const std::string& name() const { return name_; }
  /// Like run(), but neither timed nor counted.
  template <typename Fn>
  auto guarded(Fn&& fn) const -> decltype(fn()) {
    try {
      return fn();
    } catch (const std::exception& e) {
      return fail(std::string("threw: ") + e.what(), name_);
    } catch (...) {
      return fail("threw an object that is not a std::exception", name_);
    }
  }

 private:
  void record(std::int64_t duration_us, bool ok);

  const std::string name_;
  const Clock& clock_;
  mutable std::mutex mutex_;
  TimeHistogram total_, interval_;
  std::int64_t failed_ = 0;
  int failures_in_a_row_ = 0;
};

}  // namespace barehand
