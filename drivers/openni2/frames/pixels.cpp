// Copies OpenNI2's depth and colour images into frames.
#include "drivers/openni2/frames/pixels.h"

#include <algorithm>
#include <cstring>

namespace barehand {
namespace {

/// Gives the image the size of the frame.
template <class T>
void fit(const openni::VideoFrameRef& frame, Image<T>& image) {
  if (image.width() != frame.getWidth() || image.height() != frame.getHeight())
    image.reset(frame.getWidth(), frame.getHeight());
}

const std::uint8_t* row_of(const openni::VideoFrameRef& frame, int v) {
  return static_cast<const std::uint8_t*>(frame.getData()) + static_cast<std::ptrdiff_t>(v) * frame.getStrideInBytes();
}

std::uint8_t clamped(int value) { return static_cast<std::uint8_t>(std::clamp(value >> 8, 0, 255)); }

/// Converts as BT.601 specifies for video range, in 8-bit fixed point.
Rgb from_yuv(int y, int u, int v) {
  const int c = 298 * (y - 16) + 128, d = u - 128, e = v - 128;
  return {clamped(c + 409 * e), clamped(c - 100 * d - 208 * e), clamped(c + 516 * d)};
}

/// Converts formats in which two pixels share u and v. The arguments y1, u, y2 and v are the offsets of these values
/// within the four bytes of two pixels.
void convert_yuv(const std::uint8_t* in, int width, int y1, int u, int y2, int v, Rgb* out) {
  for (int x = 0; x + 1 < width; x += 2, in += 4) {
    out[x] = from_yuv(in[y1], in[u], in[v]);
    out[x + 1] = from_yuv(in[y2], in[u], in[v]);
  }
}

}  // namespace

void convert_colour_row(const std::uint8_t* in, int width, openni::PixelFormat format, Rgb* out) {
  static_assert(sizeof(Rgb) == 3);
  switch (format) {
    case openni::PIXEL_FORMAT_RGB888:
      std::memcpy(out, in, 3 * static_cast<std::size_t>(width));
      break;
    // The formats with one u and v for two pixels differ in the order of their bytes.
    case openni::PIXEL_FORMAT_YUYV:
      convert_yuv(in, width, 0, 1, 2, 3, out);
      break;
    case openni::PIXEL_FORMAT_YUV422:
      convert_yuv(in, width, 1, 0, 3, 2, out);
      break;

    // Grey gives the same value to all three colours.
    default:  // GRAY8
      for (int x = 0; x < width; ++x) out[x] = {in[x], in[x], in[x]};
  }
}

bool complete(const openni::VideoFrameRef& frame, const openni::VideoMode& mode, int bytes_per_pixel) {
  if (!frame.isValid() || frame.getData() == nullptr) return false;
  const int row = frame.getWidth() * bytes_per_pixel, stride = frame.getStrideInBytes();
  return frame.getWidth() == mode.getResolutionX() && frame.getHeight() == mode.getResolutionY() && stride >= row &&
         frame.getDataSize() >= stride * (frame.getHeight() - 1) + row;
}

void copy_depth(const openni::VideoFrameRef& frame, bool mirror, Image<std::uint16_t>& depth) {
  fit(frame, depth);
  for (int v = 0; v < depth.height(); ++v) {
    std::memcpy(depth.row(v), row_of(frame, v), 2 * static_cast<std::size_t>(depth.width()));
    if (mirror) std::reverse(depth.row(v), depth.row(v) + depth.width());
  }
}

void copy_colour(const openni::VideoFrameRef& frame, bool mirror, Image<Rgb>& colour) {
  fit(frame, colour);
  for (int v = 0; v < colour.height(); ++v) {
    convert_colour_row(row_of(frame, v), colour.width(), frame.getVideoMode().getPixelFormat(), colour.row(v));
    if (mirror) std::reverse(colour.row(v), colour.row(v) + colour.width());
  }
}

}  // namespace barehand
