#pragma once

#include "bot_core/images_t.hpp"
#include "drivers/lcm/depth_codec.h"
#include "kinect/frame_msg_t.hpp"
#include "sensor/rgbd_frame.h"

namespace barehand {

inline std::vector<std::uint8_t> raw_colour_bytes(const RgbdFrame& frame) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(frame.colour.data());
  return {first, first + 3 * frame.colour.size()};
}

/// A frame as the kinect-lcm driver would send it.
inline kinect::frame_msg_t kinect_message(const RgbdFrame& frame, bool zipped) {
  kinect::frame_msg_t m{};
  m.timestamp = frame.utime;
  m.image.width = m.depth.width = static_cast<std::int16_t>(frame.camera.width);
  m.image.height = m.depth.height = static_cast<std::int16_t>(frame.camera.height);

  // Add the colour image.
  m.image.image_data = raw_colour_bytes(frame);
  m.image.image_data_nbytes = static_cast<std::int32_t>(m.image.image_data.size());
  m.image.image_data_format = kinect::image_msg_t::VIDEO_RGB;

  // Add the depth image.
  m.depth.depth_data = encode_depth(frame.depth, zipped ? DepthEncoding::zlib : DepthEncoding::raw16);
  m.depth.depth_data_nbytes = static_cast<std::int32_t>(m.depth.depth_data.size());
  m.depth.depth_data_format = kinect::depth_msg_t::DEPTH_MM;
  m.depth.compression = zipped ? kinect::depth_msg_t::COMPRESSION_ZLIB : kinect::depth_msg_t::COMPRESSION_NONE;
  m.depth.uncompressed_size = static_cast<std::int32_t>(2 * frame.depth.size());
  return m;
}

/// A frame as libbot's camera drivers would send it: image 0 colour, image 1 depth.
inline bot_core::images_t images_message(const RgbdFrame& frame, bool zipped) {
  using bot_core::images_t;
  images_t m{};
  m.utime = frame.utime;
  m.n_images = 2;
  m.image_types = {images_t::LEFT, zipped ? images_t::DEPTH_MM_ZIPPED : images_t::DEPTH_MM};
  m.images.resize(2);

  // Describe both images.
  for (bot_core::image_t& image : m.images) {
    image.utime = frame.utime;
    image.width = frame.camera.width;
    image.height = frame.camera.height;
    image.nmetadata = 1;
    image.metadata.resize(1);
    image.metadata[0] = {"exposure", 2, {7, 8}};
  }

  // Add their pixels.
  m.images[0].pixelformat = bot_core::image_t::PIXEL_FORMAT_RGB;
  m.images[0].row_stride = 3 * frame.camera.width;
  m.images[0].data = raw_colour_bytes(frame);
  m.images[1].row_stride = 2 * frame.camera.width;
  m.images[1].data = encode_depth(frame.depth, zipped ? DepthEncoding::zlib : DepthEncoding::raw16);
  for (bot_core::image_t& image : m.images) image.size = static_cast<std::int32_t>(image.data.size());
  return m;
}

}  // namespace barehand
