#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <vector>

#include "core/clock.h"
#include "core/slot.h"
#include "pipeline/sink.h"
#include "stages/publish/pose_hold.h"

namespace barehand {

/// Number of frames of one hand in each track status, as it is published.
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
    PublishParams publish = {};
    Slot<PublishParams>* pending = nullptr;  ///< changed parameters, taken before every frame; may be null
  };
  ProgressSink(std::ostream& out, Options options, const Clock& clock);

  std::string name() const override { return "progress"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  Result<void> finish() override;
  /// The counts of each hand, in the order of the estimates.
  const std::vector<StatusCounts>& counts() const { return counts_; }
  /// The published statuses in the last frame, in the same order; empty before the first one.
  const std::vector<TrackStatus>& statuses() const { return statuses_; }

 private:
  void print(std::int64_t number, std::int64_t now_us);

  std::ostream& out_;
  Options options_;
  const Clock& clock_;
  std::vector<StatusCounts> counts_;
  std::vector<PoseHold> holds_;  // one per hand
  std::vector<TrackStatus> statuses_;
  std::int64_t done_ = 0, last_done_ = 0;
  std::int64_t last_us_;
  bool line_open_ = false;
};

}  // namespace barehand
