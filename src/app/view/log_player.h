#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "io/web/view_request.h"
#include "io/web/view_status.h"

namespace barehand {

/// Where a log that is played stands, and when its next frame is due. Owns no thread.
class LogPosition {
 public:
  /// `seconds`: of every frame since the first one, rising; not empty. `lost`: as LogIndex::lost().
  LogPosition(std::vector<double> seconds, std::vector<LostFrames> lost);

  void follow(const PlayerCommand& command, std::int64_t now_us);
  /// Nobody looks: the frame that is due now is the one that was due before.
  void wait(std::int64_t now_us) { go_to(frame_, now_us); }
  /// Goes on to the frame that is to be shown at `now_us` (steady clock). True: it is another one.
  bool advance(std::int64_t now_us);
  /// When the next frame is due, steady clock; none: nothing is played.
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
  std::int64_t shown_us_ = 0;  // when frame_ was due
  bool started_ = false;
};

}  // namespace barehand
