#pragma once

#include <cstdint>
#include <functional>
#include <ostream>

#include "core/clock.h"
#include "pipeline/sink.h"
#include "pipeline/summary.h"

namespace barehand {

/// --health: prints a line about the state of the pipeline once per period.
class HealthSink : public Sink {
 public:
  HealthSink(std::ostream& out, std::function<PipelineHealth()> health, std::int64_t period_us, const Clock& clock)
      : out_(out),
        health_(std::move(health)),
        period_us_(period_us),
        clock_(clock),
        due_us_(clock.steady_us() + period_us) {}

  std::string name() const override { return "health"; }
  Result<void> consume(const TrackedFrame&) override { return idle(); }
  Result<void> idle() override {
    if (clock_.steady_us() < due_us_) return {};
    due_us_ = clock_.steady_us() + period_us_;
    out_.clear();  // forget that an earlier write failed, for example because the pipe had no reader
    out_ << health_line(health_()) << std::endl;
    return {};
  }

 private:
  std::ostream& out_;
  const std::function<PipelineHealth()> health_;
  const std::int64_t period_us_;
  const Clock& clock_;
  std::int64_t due_us_;
};

}  // namespace barehand
