#include "drivers/synthetic/synthetic_source.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace barehand::synthetic {

// Delivers the frames of the simulator, as a replay or at the pace of a clock.

Result<std::unique_ptr<SyntheticSource>> SyntheticSource::open(const std::string& text, const Clock& clock) {
  auto spec = parse_synthetic_spec(text);
  if (!spec) return tl::unexpected(spec.error());
  auto simulator = Simulator::create(spec->simulator, spec->hands);
  if (!simulator) return tl::unexpected(simulator.error());
  return std::unique_ptr<SyntheticSource>(
      new SyntheticSource(std::move(*spec), std::move(*simulator), "sim:" + text, clock));
}

SyntheticSource::SyntheticSource(SyntheticSpec spec, Simulator simulator, std::string name, const Clock& clock)
    : spec_(std::move(spec)), simulator_(std::move(simulator)), name_(std::move(name)), clock_(clock) {
  for (const AnimatedHand& hand : simulator_.hands()) hands_.push_back({hand.profile(), {}, {}});
}

std::int64_t SyntheticSource::remaining() const {
  return spec_.loop ? -1 : std::max<std::int64_t>(0, simulator_.frame_count() - next_);
}

SourceEvent SyntheticSource::next(std::chrono::milliseconds patience) {
  if (at_end()) return EndOfStream{};
  if (spec_.live) {
    if (!wait_until_due(patience)) return Timeout{};
    if (at_end()) return EndOfStream{};
  }
  return deliver();
}

bool SyntheticSource::wait_until_due(std::chrono::milliseconds patience) {
  // Set the time of frame 0 in the first call.
  if (start_us_ < 0) {
    start_us_ = clock_.steady_us();
    start_utime_ = clock_.utime();
  }

  // Compute the time until the next frame.
  const double period_us = 1e6 / simulator_.fps();
  const auto elapsed = static_cast<double>(clock_.steady_us() - start_us_);
  const double wait_us = static_cast<double>(next_) * period_us - elapsed;
  if (wait_us <= 0) {  // the next frame is late, so continue with the newest frame that is due
    next_ = std::max(next_, static_cast<std::int64_t>(elapsed / period_us));
    return true;
  }

  const auto wait = std::chrono::microseconds(std::llround(wait_us));
  std::this_thread::sleep_for(std::min<std::chrono::microseconds>(wait, patience));
  return wait <= patience;
}

FramePtr SyntheticSource::deliver() {
  // Render the frame. Its number keeps increasing when the sequence repeats.
  const std::int64_t number = next_++;
  last_ = simulator_.render(number % simulator_.frame_count());
  auto frame = std::make_shared<RgbdFrame>(*last_.frame);

  // Set the number and the time stamp of the frame, and of the truth about it.
  const std::int64_t since_start = std::llround(1e6 * static_cast<double>(number) / simulator_.fps());
  frame->number = number;
  frame->utime = (spec_.live ? start_utime_ : Simulator::kFirstUtime) + since_start;

  // Hand over the truth about each hand.
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    hands_[i].pose = last_.hands[i].pose;
    hands_[i].truth = std::move(last_.hands[i].table);

    // The table carries the number and the time of the delivered frame.
    if (hands_[i].truth) {
      hands_[i].truth->number = number;
      hands_[i].truth->timestamp = 1e-6 * static_cast<double>(frame->utime);
    }
  }
  return frame;
}

}  // namespace barehand::synthetic
