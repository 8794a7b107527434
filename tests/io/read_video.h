#pragma once

#include <gtest/gtest.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <cstring>
#include <string>
#include <vector>

#include "sensor/rgbd_frame.h"

namespace barehand::test {

/// The images of a video as a player shows them, and its duration.
struct ReadVideo {
  std::string codec;
  double seconds = 0;  ///< duration that the file states; negative if it states none
  std::vector<Image<Rgb>> pictures;
};

inline Image<Rgb> to_rgb(const AVFrame& frame) {
  // libswscale may write a little beyond the ends of rows, so libav allocates them with padding.
  AVFrame* rgb = av_frame_alloc();
  rgb->format = AV_PIX_FMT_RGB24;
  rgb->width = frame.width;
  rgb->height = frame.height;
  EXPECT_EQ(av_frame_get_buffer(rgb, 0), 0);
  SwsContext* scaler = sws_getContext(frame.width, frame.height, static_cast<AVPixelFormat>(frame.format), frame.width,
                                      frame.height, AV_PIX_FMT_RGB24, SWS_BILINEAR, nullptr, nullptr, nullptr);
  sws_scale(scaler, frame.data, frame.linesize, 0, frame.height, rgb->data, rgb->linesize);
  sws_freeContext(scaler);

  Image<Rgb> picture(frame.width, frame.height);
  for (int v = 0; v < frame.height; ++v)
    std::memcpy(static_cast<void*>(picture.row(v)), rgb->data[0] + rgb->linesize[0] * v, sizeof(Rgb) * frame.width);
  av_frame_free(&rgb);
  return picture;
}

/// Reads a video. The result is empty if the file is no video.
inline ReadVideo read_video(const std::string& path) {
  av_log_set_level(AV_LOG_QUIET);
  ReadVideo video;
  AVFormatContext* file = nullptr;
  if (avformat_open_input(&file, ("file:" + path).c_str(), nullptr, nullptr) < 0) return video;
  avformat_find_stream_info(file, nullptr);
  EXPECT_EQ(file->nb_streams, 1);

  // Read what the file says about the video.
  const AVCodecParameters& stream = *file->streams[0]->codecpar;
  const AVCodec* codec = avcodec_find_decoder(stream.codec_id);
  video.codec = codec->name;
  video.seconds = file->duration == AV_NOPTS_VALUE ? -1 : static_cast<double>(file->duration) / AV_TIME_BASE;

  // Decode one image after the other; skip a truncated packet.
  AVCodecContext* decoder = avcodec_alloc_context3(codec);
  avcodec_parameters_to_context(decoder, &stream);
  avcodec_open2(decoder, codec, nullptr);
  AVPacket* packet = av_packet_alloc();
  AVFrame* frame = av_frame_alloc();
  for (bool more = true; more;) {
    more = av_read_frame(file, packet) >= 0;
    avcodec_send_packet(decoder, more ? packet : nullptr);
    av_packet_unref(packet);
    while (avcodec_receive_frame(decoder, frame) >= 0) video.pictures.push_back(to_rgb(*frame));
  }

  // Release the decoder and the file.
  av_frame_free(&frame);
  av_packet_free(&packet);
  avcodec_free_context(&decoder);
  avformat_close_input(&file);
  return video;
}

}  // namespace barehand::test
