#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/frame_messages.h"
#include "drivers/mcap/mcap_source.h"
#include "io/lcm/message_log.h"
#include "io/web/view_status.h"

namespace barehand {

/// The frames of one or more logs (LCM or MCAP). Messages with the same time stamp belong to one frame; its states may
/// be in one log and its image in another.
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
  std::vector<ReceivedMessage> messages(std::int64_t frame);
  /// The images of a frame where they are ROS messages of an MCAP file; null: there are none, or none that can be read.
  FramePtr image(std::int64_t frame);
  /// Sentences that say what of the logs is not shown, such as what is damaged or cut off.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Log {
    MessageLog messages;
    std::unique_ptr<McapSource> images;  // null: it is an LCM log, or has no depth images
  };
  struct Place {
    std::size_t log, entry;
  };
  struct ImagePlace {
    std::size_t log;
    std::int64_t frame;
  };
  struct Frame {
    std::int64_t utime = 0;
    std::vector<Place> places;
    std::optional<ImagePlace> image = {};
    bool any_state = false;
    bool any_image = false;
  };
  Result<void> add(const std::string& path);
  void find_frames();
  void find_lost();
  bool has_pose(const Frame& frame);

  std::vector<Log> logs_;
  std::vector<std::string> warnings_;
  std::vector<Frame> frames_;  // in the order of time
  std::vector<LostFrames> lost_;
  bool any_states_ = false;
};

}  // namespace barehand
