#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/view/frame_messages.h"
#include "io/lcm/lcm_log_reader.h"
#include "io/web/view_status.h"

namespace barehand {

/// The frames of one or more LCM logs. Messages with the same time stamp belong to one frame; its states may be in one
/// log and its image in another.
class LogIndex {
 public:
  /// Errors: a log cannot be read; none of the logs holds states or images.
  static Result<LogIndex> open(const std::vector<std::string>& paths);

  std::int64_t frames() const { return static_cast<std::int64_t>(frames_.size()); }
  /// Time of a frame since the first one [s].
  double seconds(std::int64_t frame) const;
  /// Sequences of frames in which no hand has a pose; empty if there are no states.
  const std::vector<LostFrames>& lost() const { return lost_; }
  /// The messages of a frame; those that cannot be read are left out.
  std::vector<LcmMessage> messages(std::int64_t frame);

 private:
  struct Place {
    std::size_t log, entry;
  };
  struct Frame {
    std::int64_t utime;
    std::vector<Place> places;
  };
  void find_frames();
  void find_lost();
  bool has_pose(const Frame& frame);

  std::vector<LcmLogReader> logs_;
  std::vector<Frame> frames_;  // in the order of time
  std::vector<LostFrames> lost_;
  bool any_states_ = false;
};

}  // namespace barehand
