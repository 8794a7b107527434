#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/error.h"
#include "io/whole_file.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Writes a recording folder (docs/formats.md) that open_recording reads. It is a recording when it is finished: until
/// then its lists are drafts (WholeFile). They stay complete at every moment: images first, then the line that names
/// them. After a full disk it goes on with the next frame that fits. The destructor finishes what has frames.
class RecordingWriter {
 public:
  struct Options {
    double fps = 0;                     ///< nominal rate noted in camera.json; 0 = not noted
    std::string colour_ending = "png";  ///< or "jpg": smaller, but lossy: black ("no colour here") may turn grey
  };
  /// Makes the folder. A folder that already holds a recording, or some of its files, is an error: nothing is
  /// overwritten.
  static Result<RecordingWriter> create(const std::string& directory, Options options);
  static Result<RecordingWriter> create(const std::string& directory) { return create(directory, Options{}); }
  RecordingWriter(RecordingWriter&&) noexcept = default;
  RecordingWriter& operator=(RecordingWriter&&) = delete;
  ~RecordingWriter();

  /// Appends a frame and returns its number in this recording (its line in depth.txt, from 0). The first frame
  /// fixes the intrinsics and the depth unit; later ones must agree. A full disk is an error. Times are written as they
  /// come; a source's frames are in order (FrameOrder).
  Result<std::int64_t> write(const RgbdFrame& frame);
  /// Makes a recording of what was written: all of it is on the disk when this returns. Without a frame, what was made
  /// is removed. Nothing is written afterwards.
  Result<void> finish();

 private:
  RecordingWriter() = default;
  Result<void> start(const RgbdFrame& first);
  Result<void> append(std::optional<WholeFile>& list, const char* name, const std::string& line) const;

  std::string directory_;
  Options options_;
  Intrinsics camera_;
  double depth_unit_ = 0;
  bool made_ = false, finished_ = false;            ///< the folder, which was not there; all of it
  std::optional<WholeFile> depth_list_, rgb_list_;  ///< from the first line on
  std::int64_t count_ = 0;
};

}  // namespace barehand
