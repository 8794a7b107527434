// The file that libav writes a video to.
#include "io/video/libav.h"

namespace barehand {

OutputFile::~OutputFile() {
  if (!context_) return;
  avio_closep(&context_->pb);
  avformat_free_context(context_);
}

int OutputFile::open(const char* path, const char* format) {
  const std::string url = file_url(path);
  if (const int error = avformat_alloc_output_context2(&context_, nullptr, format, url.c_str()); error < 0)
    return error;
  return avio_open(&context_->pb, url.c_str(), AVIO_FLAG_WRITE);
}

int OutputFile::write_header(AVDictionary** options) {
  if (const int error = avformat_write_header(context_, options); error < 0) return error;
  return flush();
}

int OutputFile::write(AVPacket* packet) {
  if (const int error = av_interleaved_write_frame(context_, packet); error < 0) return error;
  return flush();
}

int OutputFile::finish() {
  const int error = av_write_trailer(context_);
  const int flushed = flush();
  const int closed = avio_closep(&context_->pb);
  return error < 0 ? error : flushed < 0 ? flushed : closed;
}

int OutputFile::flush() {
  avio_flush(context_->pb);
  return context_->pb->error;
}

}  // namespace barehand
