#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "io/web/view_request.h"
#include "io/web/view_status.h"

namespace barehand {

/// The position in a log that is played, and the time when its next frame is due. Owns no thread.
class LogPosition {
 public:
  /// `seconds`: time of every frame since the first one, increasing; must not be empty. `lost`: as LogIndex::lost().
  LogPosition(std::vector<double> seconds, std::vector<LostFrames> lost);

  void follow(const PlayerCommand& command, std::int64_t now_us);
  /// Call it while no client is connected: the position stays, and the current frame is due at `now_us`.
  void wait(std::int64_t now_us) { go_to(frame_, now_us); }
  /// Moves to the frame to be shown at `now_us` (steady clock): the next one that is due, or a later one if playing is
  /// more than a quarter of a second behind. Returns whether it must be shown, since it changed or was not shown yet.
  /// Call it again until due_us() is in the future.
  bool advance(std::int64_t now_us);
  /// Time by the steady clock at which the next frame is due; none if the log is not playing.
  std::optional<std::int64_t> due_us() const;
  PlayedLog state() const;
  std::int64_t frame() const { return frame_; }

 private:
  void go_to(std::int64_t frame, std::int64_t now_us);
  std::int64_t next_lost(bool forwards) const;

  const std::vector<double> seconds_;
  const std::vector<LostFrames> lost_;
  std::int64_t frame_ = 0;
  bool playing_ = true;
  double speed_ = 1;
  std::int64_t shown_us_ = 0;  // time at which frame_ was due
  bool started_ = false;
};

}  // namespace barehand
