// Plays a log of hand states for the live page, with pauses and jumps.
#include "app/view/log_player.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {
constexpr double kLongestGap = 2.0;              // longest pause [s]; longer pauses in a log are shortened to this
constexpr std::int64_t kMostBehindUs = 250'000;  // frames that are due for longer than this are left out [us]
constexpr double kSlowest = 0.01, kFastest = 100;
}  // namespace

LogPosition::LogPosition(std::vector<double> seconds, std::vector<LostFrames> lost)
    : seconds_(std::move(seconds)), lost_(std::move(lost)) {}

void LogPosition::follow(const PlayerCommand& command, std::int64_t now_us) {
  using Kind = PlayerCommand::Kind;
  const auto last = static_cast<std::int64_t>(seconds_.size()) - 1;
  switch (command.kind) {
    case Kind::play:
      playing_ = true;
      go_to(frame_ == last ? 0 : frame_, now_us);
      break;
    case Kind::pause:
      playing_ = false;
      break;
    case Kind::seek:
      go_to(std::llround(command.value), now_us);
      break;
    case Kind::step:
      playing_ = false;
      go_to(frame_ + std::llround(command.value), now_us);
      break;
    case Kind::speed:
      if (command.value > 0) speed_ = std::clamp(command.value, kSlowest, kFastest);
      break;
    case Kind::lost:
      playing_ = false;
      go_to(next_lost(command.value >= 0), now_us);
      break;
  }
}

void LogPosition::go_to(std::int64_t frame, std::int64_t now_us) {
  frame_ = std::clamp<std::int64_t>(frame, 0, static_cast<std::int64_t>(seconds_.size()) - 1);
  shown_us_ = now_us;
  started_ = false;  // makes advance() show the frame even if it is the same one
}

/// First frame of the next sequence of frames without a hand, or of the previous one; the current frame if there is
/// none.
std::int64_t LogPosition::next_lost(bool forwards) const {
  if (forwards) {
    const auto after = std::ranges::find_if(lost_, [&](const LostFrames& lost) { return lost.first > frame_; });
    return after == lost_.end() ? frame_ : after->first;
  }
  const auto before = std::find_if(lost_.rbegin(), lost_.rend(), [&](const LostFrames& l) { return l.first < frame_; });
  return before == lost_.rend() ? frame_ : before->first;
}

std::optional<std::int64_t> LogPosition::due_us() const {
  const auto next = static_cast<std::size_t>(frame_) + 1;
  if (!playing_ || next == seconds_.size()) return std::nullopt;
  const double wait = std::min(seconds_[next] - seconds_[next - 1], kLongestGap) / speed_;
  return shown_us_ + static_cast<std::int64_t>(wait * 1e6);
}

bool LogPosition::advance(std::int64_t now_us) {
  bool moved = !started_;
  if (!started_) shown_us_ = now_us;
  started_ = true;

  // A frame that waits to be shown goes first. Of later ones every one is shown, unless playing is far behind.
  for (auto due = due_us(); due && (*due <= now_us - kMostBehindUs || (!moved && *due <= now_us)); due = due_us()) {
    shown_us_ = *due;
    ++frame_;
    moved = true;
  }
  if (frame_ + 1 == static_cast<std::int64_t>(seconds_.size())) playing_ = false;
  return moved;
}

PlayedLog LogPosition::state() const {
  return {static_cast<std::int64_t>(seconds_.size()),
          frame_,
          seconds_.back(),
          seconds_[static_cast<std::size_t>(frame_)],
          playing_,
          speed_,
          lost_};
}

}  // namespace barehand
