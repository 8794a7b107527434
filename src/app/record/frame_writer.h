#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/error.h"
#include "drivers/lcm/frame_codec.h"
#include "io/lcm/rotating_log.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// Where recorded or converted frames go. Its destructor finishes it, too, but cannot report errors.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  /// What was written before stays readable whatever happens in this call; a full disk is an error, after which the
  /// next frame may succeed.
  virtual Result<void> write(const RgbdFrame& frame) = 0;
  /// After the last frame: everything is on the disk and has its name when it returns. Nothing is left without a frame.
  virtual Result<void> finish() = 0;
  /// "LCM log /data/a.lcmlog", for messages.
  virtual std::string name() const = 0;
};

struct FrameWriterOptions {
  FrameEncoding encoding = {};               ///< of a log; else only of colour, which is raw in no other form
  std::string channel = "RGBD_FRAME";        ///< of a log
  double fps = 0;                            ///< nominal rate, noted except in a log; 0 = not noted
  bool overwrite = false;                    ///< of a file; a folder with a recording is never overwritten
  std::optional<LogRotation> rotation = {};  ///< of a log: a set of files instead of one
  const Clock* clock = nullptr;              ///< of the rotation; outlives the writer
};

/// Whether frames written to `path` make an LCM log (is_log_name), or an MCAP file.
bool is_log_path(const std::string& path);
bool is_mcap_path(const std::string& path);
/// One of these: a single file, not a folder.
bool is_file_path(const std::string& path);

/// A recording folder, or an LCM log or an MCAP file as the name says. Errors: it exists, it cannot be made, or it ends
/// in .oni, which is not written; only an LCM log rotates.
Result<std::unique_ptr<FrameWriter>> open_frame_writer(const std::string& path, const FrameWriterOptions& options);

}  // namespace barehand
