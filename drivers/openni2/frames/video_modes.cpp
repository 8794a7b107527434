// Chooses the video modes of an OpenNI2 sensor.
#include "drivers/openni2/frames/video_modes.h"

#include <array>
#include <cstdlib>
#include <limits>
#include <tuple>

namespace barehand {
namespace {

using openni::VideoMode;

/// The mode with the lowest cost; a mode whose `cost` is none cannot be used.
template <class Cost>
std::optional<VideoMode> best(const openni::SensorInfo& sensor, Cost cost) {
  std::optional<VideoMode> found;
  decltype(cost(VideoMode())) least;
  const openni::Array<VideoMode>& modes = sensor.getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    const auto price = cost(modes[i]);
    if (!price || (least && *least <= *price)) continue;
    least = price;
    found = modes[i];
  }
  return found;
}

/// Order of preference, 0 first. RGB is the best: the other formats must be converted, and have half of the colour
/// resolution or no colour.
int rank(openni::PixelFormat format) {
  switch (format) {
    case openni::PIXEL_FORMAT_RGB888:
      return 0;
    case openni::PIXEL_FORMAT_YUYV:
      return 1;
    case openni::PIXEL_FORMAT_YUV422:
      return 2;
    default:
      return 3;
  }
}

}  // namespace

double depth_unit(openni::PixelFormat format) {
  if (format == openni::PIXEL_FORMAT_DEPTH_100_UM) return 1e-4;
  return format == openni::PIXEL_FORMAT_DEPTH_1_MM ? 1e-3 : 0;
}

int colour_bytes_per_pixel(openni::PixelFormat format) {
  switch (format) {
    case openni::PIXEL_FORMAT_RGB888:
      return 3;
    case openni::PIXEL_FORMAT_YUYV:
    case openni::PIXEL_FORMAT_YUV422:
      return 2;
    case openni::PIXEL_FORMAT_GRAY8:
      return 1;
    default:
      return 0;
  }
}

std::optional<VideoMode> choose_depth_mode(const openni::SensorInfo& sensor, const OpenNiParams& wanted) {
  using Cost = std::optional<std::tuple<int, int, double>>;
  return best(sensor, [&](const VideoMode& mode) -> Cost {
    const double unit = depth_unit(mode.getPixelFormat());
    if (unit == 0) return std::nullopt;
    const int off = std::abs(mode.getResolutionX() - wanted.width) + std::abs(mode.getResolutionY() - wanted.height);
    return std::tuple(off, std::abs(mode.getFps() - wanted.fps), unit);
  });
}

std::optional<VideoMode> choose_colour_mode(const openni::SensorInfo& sensor, const VideoMode& depth) {
  using Cost = std::optional<std::tuple<int, int>>;
  return best(sensor, [&](const VideoMode& mode) -> Cost {
    const bool same_size =
        mode.getResolutionX() == depth.getResolutionX() && mode.getResolutionY() == depth.getResolutionY();
    if (!same_size || colour_bytes_per_pixel(mode.getPixelFormat()) == 0) return std::nullopt;
    return std::tuple(std::abs(mode.getFps() - depth.getFps()), rank(mode.getPixelFormat()));
  });
}

std::string to_text(const VideoMode& mode) {
  return std::to_string(mode.getResolutionX()) + "x" + std::to_string(mode.getResolutionY()) + " at " +
         std::to_string(mode.getFps()) + " Hz";
}

}  // namespace barehand
