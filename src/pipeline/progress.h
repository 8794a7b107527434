#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <vector>

#include "core/clock.h"
#include "pipeline/sink.h"

namespace barehand {

/// Frames of one hand by track status.
struct StatusCounts {
  Handedness handedness = Handedness::right;
  std::array<std::int64_t, 4> frames{};  ///< indexed by TrackStatus
  std::int64_t of(TrackStatus status) const { return frames[static_cast<int>(status)]; }
};

/// Says how a run is going: one line that is rewritten on a terminal, now and then a line elsewhere.
class ProgressSink : public Sink {
 public:
  struct Options {
    bool terminal = false;
    std::optional<std::int64_t> frames;  ///< how many will come, where that is known
    bool quiet = false;                  ///< counts alone
  };
  ProgressSink(std::ostream& out, Options options, const Clock& clock);

  std::string name() const override { return "progress"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  Result<void> finish() override;
  /// One a hand.
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
