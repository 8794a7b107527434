#pragma once

#include <array>
#include <cstdint>

namespace barehand {

/// The functions of libbarehand_video.so. The program loads it only for its first video, because it depends on more
/// than a hundred other libraries. Errors are written to `message`.
struct VideoModule {
  using Message = std::array<char, 128>;

  /// Starts a video of `format`: "mp4" (fragmented, so that an unfinished file can be played), "matroska", "webm" or
  /// "avi". Odd sizes are made even by repeating the last column and row. Returns nullptr if it cannot be started.
  void* (*open)(const char* path, const char* format, int width, int height, double fps, Message& message);
  /// Writes an image. `pixels`: R, G, B, row by row, of the size given to `open`.
  bool (*write)(void* video, const std::uint8_t* pixels, Message& message);
  /// Ends the file and frees `video`, also if it returns false.
  bool (*close)(void* video, Message& message);
  /// Copies a fragmented mp4 to an ordinary one with its index at the front.
  bool (*defragment)(const char* from, const char* to, Message& message);
};

/// The module's only symbol.
extern "C" [[gnu::visibility("default")]] const VideoModule* barehand_video_module();
inline constexpr char kVideoModuleSymbol[] = "barehand_video_module";

}  // namespace barehand
