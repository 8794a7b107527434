// Rewrites a fragmented MP4 file, so that players show its duration.
#include "io/video/libav.h"

namespace barehand {
namespace {

/// A demuxer and its file.
class InputFile {
 public:
  InputFile() = default;
  ~InputFile() { avformat_close_input(&context_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  int open(const char* path) {
    const AVInputFormat* format = av_find_input_format("mp4");
    const int error = avformat_open_input(&context_, file_url(path).c_str(), format, nullptr);
    return error < 0 ? error : avformat_find_stream_info(context_, nullptr);  // finds the image size in the data
  }
  AVFormatContext* operator->() const { return context_; }
  AVFormatContext* get() const { return context_; }

 private:
  AVFormatContext* context_ = nullptr;
};

int copy_packets(const InputFile& input, OutputFile& output) {
  const AvPacketPtr packet(av_packet_alloc());
  if (!packet) return AVERROR(ENOMEM);
  const AVStream* from = input->streams[0];
  for (;;) {
    int error = av_read_frame(input.get(), packet.get());
    if (error == AVERROR_EOF) return output.finish();
    if (error < 0) return error;
    av_packet_rescale_ts(packet.get(), from->time_base, output->streams[0]->time_base);
    packet->pos = -1;
    if (error = output.write(packet.get()); error < 0) return error;
  }
}

int copy(const char* from, const char* to) {
  InputFile input;
  if (const int error = input.open(from); error < 0) return error;
  if (input->nb_streams != 1) return AVERROR_INVALIDDATA;

  // Create the same stream in a new file.
  OutputFile output;
  if (const int error = output.open(to, "mp4"); error < 0) return error;
  AVStream* stream = avformat_new_stream(output.get(), nullptr);
  if (!stream) return AVERROR(ENOMEM);
  if (const int error = avcodec_parameters_copy(stream->codecpar, input->streams[0]->codecpar); error < 0) return error;
  stream->codecpar->codec_tag = 0;  // lets the muxer choose the tag for its format
  stream->time_base = input->streams[0]->time_base;
  stream->avg_frame_rate = input->streams[0]->avg_frame_rate;

  AVDictionary* options = nullptr;
  av_dict_set(&options, "movflags", "faststart", 0);
  const int error = output.write_header(&options);
  av_dict_free(&options);
  return error < 0 ? error : copy_packets(input, output);
}

}  // namespace

bool defragment(const char* from, const char* to, VideoModule::Message& message) {
  const int error = copy(from, to);
  if (error < 0) say(message, error);
  return error >= 0;
}

}  // namespace barehand
