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
  /// For log output and errors, e.g. "LCM log /data/a.lcmlog".
  virtual std::string name() const = 0;
};

struct FrameWriterOptions {
  FrameEncoding encoding = {};               ///< for a log; the other forms use only the colour, with raw as PNG
  std::string channel = "RGBD_FRAME";        ///< for a log
  double fps = 0;                            ///< nominal frame rate [Hz], stored except in a log; 0: not stored
  bool overwrite = false;                    ///< replace a file; a folder with a recording is never replaced
  std::optional<LogRotation> rotation = {};  ///< for a log: write a set of files instead of one
  const Clock* clock = nullptr;              ///< for the rotation; must outlive the writer
};

/// Whether `path` is written as an LCM log (is_log_name), or as an MCAP file.
bool is_log_path(const std::string& path);
bool is_mcap_path(const std::string& path);
/// One of these: a single file, not a folder.
bool is_file_path(const std::string& path);

/// Creates an LCM log or an MCAP file, as the name says, and otherwise a recording folder. Errors: it exists or cannot
/// be created, `path` ends in .oni, which is not written, or something else than an LCM log is to rotate.
Result<std::unique_ptr<FrameWriter>> open_frame_writer(const std::string& path, const FrameWriterOptions& options);

}  // namespace barehand
