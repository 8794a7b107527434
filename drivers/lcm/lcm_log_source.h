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

namespace barehand {

struct LcmLogOptions {
  std::string channel = {};  ///< a name, or a glob (matches_glob) like "CAM_*"; "": the one channel that carries frames
  std::optional<std::int64_t> start =
      {};                 ///< position of the first frame, from 0; not given: the first, backwards the last
  std::int64_t step = 1;  ///< every step-th frame; negative plays backwards
  GivenIntrinsics foreign = {};
};

/// Replays the frames of an LCM log (rgbd_frame_t, kinect.frame_msg_t, bot_core.images_t), or of a folder or set of
/// logs (find_logs) one after the other, never dropping one. A cut or damaged log replays every whole event; one of
/// several without any is left out. Messages of another type, damaged messages and frames that FrameOrder does
/// not use come as SkippedFrame. Own frames keep their numbers as far as these rise, foreign ones get their position.
class LcmLogSource : public FrameSource {
 public:
  /// Errors: no LCM log, a folder without any, no matching channel (names those there are), several channels with
  /// frames and none chosen, a start outside the log, a step of 0.
  static Result<std::unique_ptr<LcmLogSource>> open(const std::string& path, const LcmLogOptions& options = {});

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return false; }
  std::string name() const override { return "log:" + path_; }

  /// Number of events `next` will deliver before the end: for progress.
  std::int64_t remaining() const;
  /// Bytes of the files that belong to no whole event; 0 for a healthy log.
  std::int64_t damaged_bytes() const;
  /// What was wrong with each of several logs that cannot be read, holds nothing, or is still being written.
  const std::vector<Error>& left_out() const { return left_out_; }
  /// What is to be said of the frames' times, and of drafts among the logs, in sentences.
  const std::vector<std::string>& doubts() const { return doubts_; }

 private:
  /// One event, and which of the files it is in.
  struct Event {
    std::size_t file;
    LogEntry entry;
    std::int64_t number = 0;  ///< that the frame gets
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
  std::vector<Event> frames_;             ///< of the chosen channels, in file order
  std::map<std::int64_t, Error> unused_;  ///< by position: why FrameOrder does not use it
  std::vector<std::string> doubts_;
  std::int64_t next_ = 0;
  std::size_t open_ = 0;  ///< the only one of the files that may be open
};

}  // namespace barehand
