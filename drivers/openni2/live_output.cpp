// The output of a live sensor's thread: numbered frames, and notices about them.
#include "drivers/openni2/live_output.h"

namespace barehand {
namespace {

constexpr std::int64_t kRepeatEvery = 2'000'000;  // time [us] in which a problem of one kind is reported once
constexpr int kMostLost = 1000;  // a gap of more frames is not a loss: the sensor counts in another way

}  // namespace

LiveOutput::LiveOutput(std::string source, std::size_t capacity, const Clock& clock)
    : source_(std::move(source)),
      box_(capacity),
      filter_(clock, kRepeatEvery),
      waiting_(clock, kWaitingIntervalUs, kWaitingGrowth) {}

void LiveOutput::notice(const std::string& kind, const std::string& what, const std::string& remedy, bool trouble) {
  // Let a recovery always pass the filter; otherwise the last message could be about a problem that is over.
  const std::optional<std::int64_t> suppressed = trouble ? filter_.admit(kind) : 0;
  if (!suppressed.has_value()) return;
  const std::string more = *suppressed > 0 ? " (and " + std::to_string(*suppressed) + " more like this)" : "";
  box_.tell(SourceNotice{{what + more, source_, remedy}, trouble});
}

void LiveOutput::await(const std::string& kind, const std::string& what, const std::string& remedy) {
  if (waiting_.admit(kind)) box_.tell(SourceNotice{{what, source_, remedy}, true});
}

void LiveOutput::skip(const std::string& what, const std::string& remedy) {
  box_.tell(SkippedFrame{{what, source_, remedy}});
}

std::int64_t LiveOutput::number(int index) {
  const int step = last_index_ >= 0 ? index - last_index_ : 1;
  const int counted = step >= 1 && step <= kMostLost ? step : 1;
  last_index_ = index;
  ++read_;
  lost_ += counted - 1;
  return last_number_ += counted;
}

QueueHealth LiveOutput::transit() const {
  const std::int64_t read = read_, lost = lost_;
  return {"transit", 0, 0, read + lost, read, lost, {}};
}

}  // namespace barehand
