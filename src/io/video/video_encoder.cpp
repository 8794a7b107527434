// Encodes images as a video with libav.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/video/libav.h"

namespace barehand {
namespace {

struct Codec {
  const char* format;
  const char* encoder;
  AVPixelFormat pixels;
  const char* options;
};

/// The encoders of each format; the first one that is installed is used. None of them delays images, so a program that
/// is killed loses no more than the container's last fragment.
constexpr Codec kCodecs[] = {
    {"mp4", "libx264", AV_PIX_FMT_YUV420P, "preset=veryfast:tune=zerolatency:crf=20"},
    {"mp4", "mpeg4", AV_PIX_FMT_YUV420P, "flags=+qscale:global_quality=354"},
    {"matroska", "libx264", AV_PIX_FMT_YUV420P, "preset=veryfast:tune=zerolatency:crf=20"},
    {"matroska", "mpeg4", AV_PIX_FMT_YUV420P, "flags=+qscale:global_quality=354"},
    {"webm", "libvpx-vp9", AV_PIX_FMT_YUV420P, "deadline=realtime:cpu-used=7:lag-in-frames=0:crf=28:b=0"},
    {"webm", "libvpx", AV_PIX_FMT_YUV420P, "deadline=realtime:cpu-used=7:lag-in-frames=0:crf=10:b=4M"},
    {"avi", "mjpeg", AV_PIX_FMT_YUVJ420P, "flags=+qscale:global_quality=354"},
};

/// With these options, an unfinished file can be played up to its last fragment or cluster, about a second before the
/// newest image.
const char* muxer_options(const char* format) {
  if (std::strcmp(format, "mp4") == 0) return "movflags=frag_keyframe+empty_moov+default_base_moof";
  if (std::strcmp(format, "avi") == 0) return "";
  return "cluster_time_limit=1000";
}

constexpr int even(int length) { return length + length % 2; }

class Options {
 public:
  explicit Options(const char* text) { av_dict_parse_string(&options_, text, "=", ":", 0); }
  ~Options() { av_dict_free(&options_); }
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;
  AVDictionary** get() { return &options_; }

 private:
  AVDictionary* options_ = nullptr;
};

struct FreeScaler {
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};

/// One video that is being written. Its functions return an error below 0, as libav does.
class Video {
 public:
  int open(const char* path, const char* format, int width, int height, double fps) {
    width_ = width;
    height_ = height;
    if (const int error = file_.open(path, format); error < 0) return error;
    if (const int error = open_encoder(format, fps); error < 0) return error;

    // Allocate the images for the conversion of colours. libswscale works in blocks and may access memory beyond the
    // end of a row, so an image is first copied to rows that libav has allocated.
    packet_.reset(av_packet_alloc());
    if (!packet_) return AVERROR(ENOMEM);
    if (const int error = allocate(picture_, AV_PIX_FMT_RGB24); error < 0) return error;
    if (const int error = allocate(frame_, encoder_->pix_fmt); error < 0) return error;
    scaler_.reset(sws_getContext(encoder_->width, encoder_->height, AV_PIX_FMT_RGB24, encoder_->width, encoder_->height,
                                 encoder_->pix_fmt, SWS_BILINEAR | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
    if (!scaler_) return AVERROR(ENOMEM);

    // Create the file's only stream.
    AVStream* stream = avformat_new_stream(file_.get(), nullptr);
    if (!stream) return AVERROR(ENOMEM);
    stream->time_base = encoder_->time_base;
    stream->avg_frame_rate = encoder_->framerate;
    if (const int error = avcodec_parameters_from_context(stream->codecpar, encoder_.get()); error < 0) return error;
    return file_.write_header(Options(muxer_options(format)).get());
  }

  int write(const std::uint8_t* pixels) {
    if (const int error = av_frame_make_writable(frame_.get()); error < 0) return error;
    copy(pixels);
    sws_scale(scaler_.get(), picture_->data, picture_->linesize, 0, picture_->height, frame_->data, frame_->linesize);
    frame_->pts = pictures_++;
    return encode(frame_.get());
  }

  int close() {
    const int error = encode(nullptr);
    const int finished = file_.finish();
    return error < 0 ? error : finished;
  }

 private:
  static constexpr int kChannels = 3;

  int open_encoder(const char* format, double fps) {
    // Find the first codec of this format that is installed.
    const AVCodec* found = nullptr;
    const Codec* codec = std::begin(kCodecs);
    for (; codec != std::end(kCodecs); ++codec)
      if (std::strcmp(codec->format, format) == 0 && (found = avcodec_find_encoder_by_name(codec->encoder))) break;
    if (!found) return AVERROR_ENCODER_NOT_FOUND;

    // Set the size and the rate of the pictures.
    encoder_.reset(avcodec_alloc_context3(found));
    if (!encoder_) return AVERROR(ENOMEM);
    encoder_->width = even(width_);
    encoder_->height = even(height_);
    encoder_->pix_fmt = codec->pixels;
    encoder_->framerate = av_d2q(fps, 60'000);  // a fraction with small numbers, since MPEG-4 stores them in 16 bits
    encoder_->time_base = av_inv_q(encoder_->framerate);

    // Choose the distance of key frames, and state the colour space of the pixels.
    encoder_->gop_size = std::clamp(static_cast<int>(std::lround(fps)), 1, 120);  // one key frame per second
    encoder_->colorspace = AVCOL_SPC_SMPTE170M;  // the colour space that libswscale converts to by default
    encoder_->color_range = codec->pixels == AV_PIX_FMT_YUVJ420P ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;

    // Open the encoder with one thread, and with its header where the file format keeps it.
    encoder_->thread_count = 1;  // leaves the other cores to the tracker
    if (file_->oformat->flags & AVFMT_GLOBALHEADER) encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    return avcodec_open2(encoder_.get(), found, Options(codec->options).get());
  }

  int allocate(AvFramePtr& frame, AVPixelFormat pixels) const {
    frame.reset(av_frame_alloc());
    if (!frame) return AVERROR(ENOMEM);
    frame->format = pixels;
    frame->width = encoder_->width;
    frame->height = encoder_->height;
    return av_frame_get_buffer(frame.get(), 0);
  }

  /// Copies an image; repeats the last column and row if their number is odd.
  void copy(const std::uint8_t* pixels) {
    const std::size_t length = kChannels * static_cast<std::size_t>(width_);
    for (int v = 0; v < picture_->height; ++v) {
      const std::uint8_t* from = pixels + length * static_cast<std::size_t>(std::min(v, height_ - 1));
      std::uint8_t* to = picture_->data[0] + static_cast<std::ptrdiff_t>(picture_->linesize[0]) * v;
      std::copy_n(from, length, to);
      if (width_ < picture_->width) std::copy_n(from + length - kChannels, kChannels, to + length);
    }
  }

  /// Encodes a frame and writes the packets; with nullptr, those that the encoder still holds.
  int encode(const AVFrame* frame) {
    int error = avcodec_send_frame(encoder_.get(), frame);
    while (error >= 0) {
      error = avcodec_receive_packet(encoder_.get(), packet_.get());
      if (error == AVERROR(EAGAIN) || error == AVERROR_EOF) return 0;
      if (error < 0) break;
      packet_->duration = 1;
      av_packet_rescale_ts(packet_.get(), encoder_->time_base, file_->streams[0]->time_base);
      error = file_.write(packet_.get());
    }
    return error;
  }

  int width_ = 0, height_ = 0;
  std::int64_t pictures_ = 0;
  OutputFile file_;
  std::unique_ptr<AVCodecContext, FreeByAddress<avcodec_free_context>> encoder_;
  AvFramePtr picture_, frame_;
  AvPacketPtr packet_;
  std::unique_ptr<SwsContext, FreeScaler> scaler_;
};

void* open_video(const char* path, const char* format, int width, int height, double fps,
                 VideoModule::Message& message) {
  av_log_set_level(AV_LOG_QUIET);
  auto video = std::make_unique<Video>();
  const int error = video->open(path, format, width, height, fps);
  if (error >= 0) return video.release();
  say(message, error);
  return nullptr;
}

bool write_picture(void* video, const std::uint8_t* pixels, VideoModule::Message& message) {
  const int error = static_cast<Video*>(video)->write(pixels);
  if (error < 0) say(message, error);
  return error >= 0;
}

bool close_video(void* video, VideoModule::Message& message) {
  const std::unique_ptr<Video> owned(static_cast<Video*>(video));
  const int error = owned->close();
  if (error < 0) say(message, error);
  return error >= 0;
}

}  // namespace

const VideoModule* barehand_video_module() {
  static constexpr VideoModule kModule = {open_video, write_picture, close_video, defragment};
  return &kModule;
}

}  // namespace barehand
