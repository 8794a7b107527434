#pragma once

#include <exception>
#include <mutex>
#include <string>
#include <utility>

#include "core/clock.h"
#include "core/error.h"
#include "core/statistics.h"

namespace barehand {

/// Stands around one stage: times every call, turns what it throws into an error and counts failures. One thread runs
/// the stage; any thread may ask for its health.
class StageMonitor {
 public:
  StageMonitor(std::string name, const Clock& clock) : name_(std::move(name)), clock_(clock) {}

  /// fn() -> Result<T>.
  template <typename Fn>
  auto run(Fn&& fn) -> decltype(fn()) {
    const std::int64_t start = clock_.steady_us();
    auto result = guarded(std::forward<Fn>(fn));
    record(clock_.steady_us() - start, result.has_value());
    return result;
  }

  /// Since the start of the run.
  StageHealth health() const;
  /// Times since the last call; failures since the start.
  StageHealth take_interval();
  /// Failures since the last success.
  int failures_in_a_row() const;
  const std::string& name() const { return name_; }
  /// As run(), neither timed nor counted.
  template <typename Fn>
  auto guarded(Fn&& fn) const -> decltype(fn()) {
    try {
      return fn();
    } catch (const std::exception& e) {
      return fail(std::string("threw: ") + e.what(), name_);
    } catch (...) {
      return fail("threw something that is no std::exception", name_);
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
