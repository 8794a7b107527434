#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <memory>
#include <string>

#include "io/video/video_module.h"

namespace barehand {

// RAII wrappers of libav for the video module: frames, packets, and OutputFile, a muxer with its file.

/// Deleter that calls a function of libav which takes the address of the pointer.
template <auto function>
struct FreeByAddress {
  template <typename T>
  void operator()(T* object) const {
    function(&object);
  }
};
using AvFramePtr = std::unique_ptr<AVFrame, FreeByAddress<av_frame_free>>;
using AvPacketPtr = std::unique_ptr<AVPacket, FreeByAddress<av_packet_free>>;

/// The URL of a file. libav would read a plain name as a URL, and the text before a colon in it as the protocol.
inline std::string file_url(const char* path) { return std::string("file:") + path; }

/// A muxer and its file.
class OutputFile {
 public:
  OutputFile() = default;
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// These functions return an error below 0, as libav does.
  int open(const char* path, const char* format);
  int write_header(AVDictionary** options);
  /// Takes the packet over; its data are in the file on return.
  int write(AVPacket* packet);
  /// Ends the file.
  int finish();
  AVFormatContext* operator->() const { return context_; }
  AVFormatContext* get() const { return context_; }

 private:
  /// Writes buffered bytes to the file and returns the error, which muxers do not check.
  int flush();
  AVFormatContext* context_ = nullptr;
};

/// Writes libav's text for an error into `message`.
inline void say(VideoModule::Message& message, int error) { av_strerror(error, message.data(), message.size()); }

/// Copies a fragmented mp4 to an ordinary one (VideoModule::defragment).
bool defragment(const char* from, const char* to, VideoModule::Message& message);

}  // namespace barehand
