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

/// libav's functions of this kind take the address of the pointer.
template <auto function>
struct FreeByAddress {
  template <typename T>
  void operator()(T* object) const {
    function(&object);
  }
};
using AvFramePtr = std::unique_ptr<AVFrame, FreeByAddress<av_frame_free>>;
using AvPacketPtr = std::unique_ptr<AVPacket, FreeByAddress<av_packet_free>>;

/// libav takes names for URLs otherwise, and what stands before a colon for a protocol.
inline std::string file_url(const char* path) { return std::string("file:") + path; }

/// A muxer and its file.
class OutputFile {
 public:
  OutputFile() = default;
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Errors below 0, as libav's.
  int open(const char* path, const char* format);
  int write_header(AVDictionary** options);
  /// Takes the packet; it is in the file when this returns.
  int write(AVPacket* packet);
  /// Ends the file.
  int finish();
  AVFormatContext* operator->() const { return context_; }
  AVFormatContext* get() const { return context_; }

 private:
  /// The muxers do not look at what became of their bytes.
  int flush();
  AVFormatContext* context_ = nullptr;
};

/// Puts libav's error into words.
inline void say(VideoModule::Message& message, int error) { av_strerror(error, message.data(), message.size()); }

bool defragment(const char* from, const char* to, VideoModule::Message& message);

}  // namespace barehand
