#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/video/video_module.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// libavformat's name for the format of a video with the ending of `path`, in upper or lower case: .mp4, .mkv, .webm or
/// .avi. nullptr for another ending.
const char* video_format(const std::string& path);

/// Loads `library`, by default libbarehand_video.so of this installation or build. Error: it, or a library that it
/// needs, is missing.
Result<const VideoModule*> load_video_module(const std::string& library = "");

/// A video that gets its name when it is complete. Until then, and if the program is killed, it is a draft
/// (AtomicFile), which can be played up to about a second before its end.
class VideoFile {
 public:
  /// Errors: no video module, no encoder for the format, and those of AtomicFile.
  static Result<VideoFile> create(const std::string& path, double fps);
  VideoFile(VideoFile&&) noexcept;
  VideoFile& operator=(VideoFile&&) = delete;
  ~VideoFile();

  /// Writes an image. Errors: a full disk, after which nothing more can be written; an image that differs in size from
  /// the first.
  Result<void> write(const Image<Rgb>& picture);
  /// Ends the video and gives it its name; the destructor does so too, but cannot report errors. Without an image there
  /// is no file. After a full disk it stays a draft, which the error names.
  Result<void> finish();

 private:
  VideoFile(const VideoModule* module, std::string path, double fps, AtomicFile file);
  /// Gives the video up; every later call returns this error.
  tl::unexpected<Error> broken(const VideoModule::Message& message);
  /// Turns a fragmented mp4 into an ordinary one, which more players show. If that fails, it stays fragmented.
  void defragment();

  const VideoModule* module_;
  std::string path_;
  double fps_;
  AtomicFile file_;
  void* video_ = nullptr;  ///< the module's handle; nullptr before the first image and after the end
  int width_ = 0, height_ = 0;
  std::optional<Error> broken_;  ///< why nothing more can be written
};

}  // namespace barehand
