#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <vector>

#include "core/clock.h"
#include "pipeline/sink.h"

namespace barehand {

/// Number of frames of one hand in each track status.
struct StatusCounts {
  Handedness handedness = Handedness::right;
  std::array<std::int64_t, 4> frames{};  ///< indexed by TrackStatus
  std::int64_t of(TrackStatus status) const { return frames[static_cast<int>(status)]; }
};

/// Prints the progress of a run: on a terminal one line that is rewritten, otherwise a new line every ten seconds.
class ProgressSink : public Sink {
 public:
  struct Options {
    bool terminal = false;
    std::optional<std::int64_t> frames;  ///< number of frames of the source, if it is known
    bool quiet = false;                  ///< only count, print nothing
  };
  ProgressSink(std::ostream& out, Options options, const Clock& clock);

  std::string name() const override { return "progress"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  Result<void> finish() override;
  /// The counts of each hand, in the order of the estimates.
  const std::vector<StatusCounts>& counts() const { return counts_; }

 private:
  void print(const HandEstimates& estimates, std::int64_t now_us);

  std::ostream& out_;
  const Options options_;
  const Clock& clock_;
  std::vector<StatusCounts> counts_;
  std::int64_t done_ = 0, last_done_ = 0;
  std::int64_t last_us_;
  bool line_open_ = false;
};

}  // namespace barehand
