#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <type_traits>
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

  /// Calls fn(args...), which must return a Result<T>. Measures its time and counts its failures.
  template <typename Fn, typename... Args, typename Outcome = std::invoke_result_t<Fn, Args...>>
  Outcome run(Fn&& fn, Args&&... args) {
    const std::int64_t start = clock_.steady_us();
    Outcome result = tl::unexpected(Error());
    try {
      result = std::invoke(std::forward<Fn>(fn), std::forward<Args>(args)...);
    } catch (...) {
      result = thrown();
    }
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
  /// Calls fn() like run(), but neither measures its time nor counts its failures.
  template <typename Fn>
  auto guarded(Fn&& fn) const -> decltype(fn()) {
    try {
      return fn();
    } catch (...) {
      return thrown();
    }
  }

 private:
  // Describes the exception that is being handled.
  tl::unexpected<Error> thrown() const;
  void record(std::int64_t duration_us, bool ok);

  const std::string name_;
  const Clock& clock_;
  mutable std::mutex mutex_;
  TimeHistogram total_, interval_;
  std::int64_t failed_ = 0;
  int failures_in_a_row_ = 0;
};

}  // namespace barehand
