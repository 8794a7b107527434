#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/error.h"
#include "drivers/lcm/frame_codec.h"
#include "io/lcm/rotating_log.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// The destination of recorded or converted frames. The destructor finishes it, too, but cannot report errors.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  /// Writes a frame. Whatever happens in this call, frames written before stay readable. A full disk is an error, after
  /// which later frames may succeed.
  virtual Result<void> write(const RgbdFrame& frame) = 0;
  /// Call it after the last frame. On return, everything is on the disk under its final name. If no frame was written,
  /// nothing is left on the disk.
  virtual Result<void> finish() = 0;
  /// The name of the destination for messages, such as "LCM log /data/a.lcmlog". After finish() failed, it names the
  /// file where the frames are.
  virtual std::string name() const = 0;
};

struct FrameWriterOptions {
  FrameEncoding encoding = {};         ///< encodings in a log; other forms use that of colour only, with raw as PNG
  std::string channel = "RGBD_FRAME";  ///< channel of the frames in a log
  double fps = 0;                      ///< nominal frame rate [Hz], stored except in a log; 0: not stored
  bool overwrite = false;              ///< replace a file; a folder with a recording is never replaced
  std::optional<LogRotation> rotation = {};  ///< for a log: write a set of files instead of one
  const Clock* clock = nullptr;              ///< for the rotation; must outlive the writer
};

/// Whether `path` is written as an LCM log (is_log_name), or as an MCAP file.
bool is_log_path(const std::string& path);
bool is_mcap_path(const std::string& path);
/// Whether `path` is written as one of these two, a single file, and not as a folder.
bool is_file_path(const std::string& path);
/// The endings of such files, for messages.
inline constexpr const char* kFileEndings = ".lcmlog or .mcap";

/// Creates an LCM log, an MCAP file or a recording folder, depending on the ending of `path`. Errors: it exists or
/// cannot be created, or a rotation is requested for something else than an LCM log.
Result<std::unique_ptr<FrameWriter>> open_frame_writer(const std::string& path, const FrameWriterOptions& options);

}  // namespace barehand
