#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/error.h"
#include "io/atomic_file.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Writes a recording folder (docs/formats.md) that open_recording reads. It becomes a recording when it is finished;
/// until then its lists are drafts (AtomicFile). The lists are valid at every moment, since an image is written before
/// the line that names it. After a full disk, writing continues with the next frame that fits. The destructor finishes
/// a recording that has frames.
class RecordingWriter {
 public:
  struct Options {
    double fps = 0;                     ///< nominal rate stored in camera.json; 0 = not stored
    std::string colour_ending = "png";  ///< "png", or the smaller but lossy "jpg", in which black may turn grey
  };
  /// Creates the folder. A folder that already holds a recording, or some of its files, is an error: nothing is
  /// overwritten.
  static Result<RecordingWriter> create(const std::string& directory, Options options);
  static Result<RecordingWriter> create(const std::string& directory) { return create(directory, Options{}); }
  RecordingWriter(RecordingWriter&&) noexcept = default;
  RecordingWriter& operator=(RecordingWriter&&) = delete;
  ~RecordingWriter();

  /// Appends a frame and returns its number in this recording (its line in depth.txt, from 0). The first frame fixes
  /// the intrinsics and the depth unit; later ones must agree. A full disk is an error. Time stamps are written
  /// unchanged; sources deliver frames in order (FrameOrder).
  Result<std::int64_t> write(const RgbdFrame& frame);
  /// Finishes the recording: on return, all of it is on the disk. Without a frame, everything that was created is
  /// removed. Nothing can be written afterwards.
  Result<void> finish();

 private:
  RecordingWriter() = default;
  Result<void> start(const RgbdFrame& first);
  Result<void> append(std::optional<AtomicFile>& list, const char* name, const std::string& line) const;

  std::string directory_;
  Options options_;
  Intrinsics camera_;
  double depth_unit_ = 0;
  bool made_ = false, finished_ = false;             ///< whether it created the folder, and whether finish() was called
  std::optional<AtomicFile> depth_list_, rgb_list_;  ///< created with their first line
  std::int64_t count_ = 0;
};

}  // namespace barehand
