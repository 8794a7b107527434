#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "io/video/video_module.h"
#include "io/whole_file.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// The extension of a name, with its dot, in lower case.
std::string lower_case_ending(const std::string& path);

/// libavformat's name for the video that the ending of `path` asks for, in upper or lower case: .mp4, .mkv, .webm or
/// .avi. nullptr: another ending.
const char* video_format(const std::string& path);

/// Loads `library`, by default libbarehand_video.so of this installation or build. Error: it, or a library that it
/// needs, is missing.
Result<const VideoModule*> load_video_module(const std::string& library = "");

/// A video that appears under its name when it is whole. Until then it is a draft (WholeFile), which plays up to about
/// a second before its end, also where the program was killed.
class VideoFile {
 public:
  /// Errors: no video module, no encoder for the format, and those of WholeFile.
  static Result<VideoFile> create(const std::string& path, double fps);
  VideoFile(VideoFile&&) noexcept;
  VideoFile& operator=(VideoFile&&) = delete;
  ~VideoFile();

  /// Errors: a full disk, after which the video takes nothing more; a picture of another size than the first.
  Result<void> write(const Image<Rgb>& picture);
  /// Ends the video and gives it its name; the destructor does so too, but cannot report errors. Without a picture
  /// there is no file. After a full disk it stays a draft, which the error names.
  Result<void> finish();

 private:
  VideoFile(const VideoModule* module, std::string path, double fps, WholeFile file);
  /// Gives the video up, for good.
  tl::unexpected<Error> broken(const VideoModule::Message& message);
  /// An mp4 in fragments becomes an ordinary one, which more players show. Where that fails it stays what it is.
  void defragment();

  const VideoModule* module_;
  std::string path_;
  double fps_;
  WholeFile file_;
  void* video_ = nullptr;  ///< the module's; nullptr before the first picture and after the end
  int width_ = 0, height_ = 0;
  std::optional<Error> broken_;  ///< why the file takes nothing more
};

}  // namespace barehand
