#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/lcm/foreign_frames.h"
#include "io/lcm/lcm_log_reader.h"
#include "sensor/frame_source.h"
#include "sensor/replay_position.h"

namespace barehand {

// A source that replays the frames of LCM logs.

struct LcmLogOptions {
  std::string channel = {};  ///< a name, or a glob (matches_glob) like "CAM_*"; "": the only channel with frames
  std::optional<std::int64_t> start = {};  ///< index of the first frame; none: the first; backwards: the last
  std::int64_t step = 1;                   ///< every step-th frame; negative plays backwards
  GivenIntrinsics foreign = {};
};

/// Replays the frames of an LCM log (rgbd_frame_t, kinect.frame_msg_t, bot_core.images_t), or of a folder or set of
/// logs (find_logs) one after the other, without dropping any frame. All complete events of a truncated or damaged log
/// are replayed; among several logs, one without any complete event is left out. For messages of another type, damaged
/// messages and frames that FrameOrder rejects, next() returns a SkippedFrame. Frames in rgbd_frame_t keep their
/// numbers as long as these increase; frames of other types are numbered by their index.
class LcmLogSource : public FrameSource {
 public:
  /// Errors: no LCM log, a folder without any, no matching channel (the error names those that exist), several channels
  /// with frames and none chosen, a start outside the log, a step of 0.
  static Result<std::unique_ptr<LcmLogSource>> open(const std::string& path, const LcmLogOptions& options = {});

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return false; }
  std::string name() const override { return "log:" + path_; }

  /// Number of events that `next` will still deliver, for showing progress.
  std::int64_t remaining() const { return position_.remaining(); }
  /// Frame rate [Hz], computed from the median time between two frames and rounded to 0.01 Hz; 0: not known.
  double fps() const;
  /// Number of bytes that belong to no complete event; 0 for a healthy log.
  std::int64_t damaged_bytes() const;
  /// The reason for each log that was left out: it cannot be read, holds nothing, or is still being written.
  const std::vector<Error>& left_out() const { return left_out_; }
  /// Warnings for the user about the frames' time stamps and about unfinished logs.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  /// An event and the index of its file.
  struct Event {
    std::size_t file;
    LogEntry entry;
    std::int64_t number = 0;  ///< the number that its frame gets
  };
  LcmLogSource(std::string path, const LcmLogOptions& options) : path_(std::move(path)), options_(options) {}
  Result<void> open_files();
  Result<void> choose();
  void put_in_order();
  SourceEvent read(std::int64_t position);

  std::string path_;
  LcmLogOptions options_;
  std::vector<LcmLogReader> files_;
  std::vector<Error> left_out_;
  std::vector<Event> frames_;             ///< events of the chosen channels, in the order of the files
  std::map<std::int64_t, Error> unused_;  ///< why FrameOrder rejects a frame, by the frame's index in frames_
  std::vector<std::string> warnings_;
  ReplayPosition position_;
  std::size_t open_ = 0;  ///< index of the only file that may be open
};

}  // namespace barehand
