#pragma once

#include <array>
#include <cstdint>

namespace barehand {

/// What libbarehand_video.so offers. The program loads it with its first video, because the libraries that it needs in
/// turn are more than a hundred. What goes wrong is said in `message`.
struct VideoModule {
  using Message = std::array<char, 128>;

  /// Starts a video of `format`: "mp4" (in fragments, which play although the file has no end), "matroska", "webm" or
  /// "avi". Odd sizes are made even by repeating the last column and row. nullptr: it cannot be started.
  void* (*open)(const char* path, const char* format, int width, int height, double fps, Message& message);
  /// `pixels`: R, G, B, row by row, of the size given to `open`.
  bool (*write)(void* video, const std::uint8_t* pixels, Message& message);
  /// Ends the file and frees `video`, whatever it returns.
  bool (*close)(void* video, Message& message);
  /// Copies an mp4 in fragments to an ordinary one whose index stands at its front.
  bool (*defragment)(const char* from, const char* to, Message& message);
};

/// The module's only symbol.
extern "C" [[gnu::visibility("default")]] const VideoModule* barehand_video_module();
inline constexpr char kVideoModuleSymbol[] = "barehand_video_module";

}  // namespace barehand
