// Prints the progress of a run and counts the status of each hand.
#include "pipeline/progress.h"

#include <ostream>

#include "core/format.h"
#include "hand/status_name.h"

namespace barehand {
namespace {
constexpr std::int64_t kTerminalPeriodUs = 250'000;
constexpr std::int64_t kLogPeriodUs = 10'000'000;
}  // namespace

ProgressSink::ProgressSink(std::ostream& out, Options options, const Clock& clock)
    : out_(out), options_(options), clock_(clock), last_us_(clock.steady_us()) {}

Result<void> ProgressSink::consume(const TrackedFrame& tracked) {
  ++done_;

  // With new parameters the messages of the hands begin anew (HandMessageMakers), and so does what is counted.
  if (const auto params = options_.pending ? options_.pending->take() : std::nullopt) {
    options_.publish = *params;
    holds_.clear();
  }

  // Count each hand as it is published: a hand that the tracker has lost is held at first.
  counts_.resize(tracked.estimates.size());
  holds_.resize(counts_.size());
  statuses_.resize(counts_.size());
  for (std::size_t k = 0; k < counts_.size(); ++k) {
    statuses_[k] = holds_[k].update(*tracked.estimates[k], options_.publish).status;
    counts_[k].handedness = tracked.estimates[k]->handedness;
    ++counts_[k].frames[static_cast<int>(statuses_[k])];
  }

  // Print when it is time.
  const std::int64_t now = clock_.steady_us();
  if (options_.quiet) return {};
  if (now - last_us_ >= (options_.terminal ? kTerminalPeriodUs : kLogPeriodUs))
    print(tracked.estimates[0]->number, now);
  return {};
}

void ProgressSink::print(std::int64_t number, std::int64_t now_us) {
  const double rate = (done_ - last_done_) * 1e6 / static_cast<double>(now_us - last_us_);
  const std::string total = options_.frames ? formatted("/%lld", static_cast<long long>(*options_.frames)) : "";
  const std::string line =
      formatted("%lld%s frames, %.1f frames/s, frame %lld: %s", static_cast<long long>(done_), total.c_str(), rate,
                static_cast<long long>(number), status_list(statuses_).c_str());
  out_.clear();  // forget that an earlier write failed, for example because the pipe had no reader
  out_ << (options_.terminal ? "\r\x1b[K" : "") << line << (options_.terminal ? "" : "\n") << std::flush;
  line_open_ = options_.terminal;
  last_us_ = now_us;
  last_done_ = done_;
}

Result<void> ProgressSink::finish() {
  if (line_open_) out_ << "\r\x1b[K" << std::flush;
  line_open_ = false;
  return {};
}

}  // namespace barehand
