#include "openni2/virtual_device/stream.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

namespace barehand::virtual_openni {
namespace {

template <class T>
OniStatus give(const T& value, void* data, int* size) {
  if (*size < static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof value);
  *size = sizeof value;
  return ONI_STATUS_OK;
}

float field_of_view(int pixels, double focal) { return static_cast<float>(2 * std::atan(pixels / 2.0 / focal)); }

bool same(const OniVideoMode& a, const OniVideoMode& b) {
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX && a.resolutionY == b.resolutionY;
}

}  // namespace

Stream::Stream(OniSensorType sensor, const Intrinsics& camera, const Settings& settings)
    : sensor_(sensor),
      camera_(camera),
      fps_(settings.fps),
      field_of_view_(settings.field_of_view),
      mirror_fixed_(settings.mirror_fixed),
      mode_(best_mode(sensor, camera, settings.fps)) {
  if (sensor == ONI_SENSOR_DEPTH) mode_.pixelFormat = ONI_PIXEL_FORMAT_DEPTH_1_MM;  // like a PrimeSense after its start
}

OniVideoMode Stream::best_mode(OniSensorType sensor, const Intrinsics& camera, double fps) {
  const OniPixelFormat format = sensor == ONI_SENSOR_DEPTH ? ONI_PIXEL_FORMAT_DEPTH_100_UM : ONI_PIXEL_FORMAT_RGB888;
  return {format, camera.width, camera.height, static_cast<int>(std::lround(fps))};
}

bool Stream::mode_possible(const OniVideoMode& mode) const {
  OniVideoMode possible = best_mode(sensor_, camera_, fps_);
  if (same(mode, possible)) return true;
  possible.pixelFormat = ONI_PIXEL_FORMAT_DEPTH_1_MM;
  return sensor_ == ONI_SENSOR_DEPTH && same(mode, possible);
}

OniStatus Stream::setProperty(int id, const void* data, int size) {
  const std::lock_guard lock(mutex_);
  if (id == ONI_STREAM_PROPERTY_VIDEO_MODE && size == sizeof(OniVideoMode)) {
    const OniVideoMode& wanted = *static_cast<const OniVideoMode*>(data);
    if (!mode_possible(wanted)) return ONI_STATUS_BAD_PARAMETER;
    mode_ = wanted;
    return ONI_STATUS_OK;
  }
  if (id == ONI_STREAM_PROPERTY_MIRRORING && size == sizeof(OniBool) && !mirror_fixed_) {
    mirrored_ = *static_cast<const OniBool*>(data) != 0;
    return ONI_STATUS_OK;
  }
  return ONI_STATUS_NOT_SUPPORTED;
}

OniStatus Stream::getProperty(int id, void* data, int* size) {
  if (!isPropertySupported(id)) return ONI_STATUS_NOT_SUPPORTED;
  const std::lock_guard lock(mutex_);
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return give(mode_, data, size);
    case ONI_STREAM_PROPERTY_CROPPING:
      return give(OniCropping{}, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return give(field_of_view(camera_.width, camera_.fx), data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return give(field_of_view(camera_.height, camera_.fy), data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return give(mode_.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM ? 65535 : 10000, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return give(0, data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return give(static_cast<OniBool>(mirrored_), data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniBool Stream::isPropertySupported(int id) {
  const bool depth_only = id == ONI_STREAM_PROPERTY_MAX_VALUE || id == ONI_STREAM_PROPERTY_MIN_VALUE;
  const bool angle = id == ONI_STREAM_PROPERTY_HORIZONTAL_FOV || id == ONI_STREAM_PROPERTY_VERTICAL_FOV;
  const bool both = id == ONI_STREAM_PROPERTY_VIDEO_MODE || id == ONI_STREAM_PROPERTY_CROPPING ||
                    id == ONI_STREAM_PROPERTY_MIRRORING || (angle && field_of_view_);
  return both || (depth_only && sensor_ == ONI_SENSOR_DEPTH);
}

OniStatus Stream::start() {
  const std::lock_guard lock(mutex_);
  if (refuse_start_) return ONI_STATUS_ERROR;
  running_ = true;
  return ONI_STATUS_OK;
}

void Stream::stop() {
  const std::lock_guard lock(mutex_);
  running_ = false;
}

void Stream::deliver(const Exposure& exposure) {
  const std::lock_guard lock(mutex_);
  if (!running_) return;
  OniFrame* frame = getServices().acquireFrame();
  if (!frame) return;
  const int pixel_bytes = sensor_ == ONI_SENSOR_DEPTH ? 2 : 3;

  // Describe the frame.
  frame->sensorType = sensor_;
  frame->timestamp = exposure.device_us;
  frame->frameIndex = exposure.index;
  frame->videoMode = mode_;
  frame->width = camera_.width;
  frame->height = camera_.height;
  frame->stride = camera_.width * pixel_bytes;
  frame->croppingEnabled = FALSE;
  frame->cropOriginX = frame->cropOriginY = 0;
  frame->dataSize = frame->stride * frame->height;

  // Fill in the pixels.
  if (sensor_ == ONI_SENSOR_DEPTH) {
    paint_depth(exposure, static_cast<std::uint16_t*>(frame->data));
  } else {
    paint_colour(exposure, static_cast<std::uint8_t*>(frame->data));
  }

  // Deliver it.
  if (exposure.fault == "short") frame->dataSize /= 2;
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

void Stream::paint_depth(const Exposure& exposure, std::uint16_t* out) const {
  // The faults.
  const Image<std::uint16_t>& depth = exposure.picture->depth;
  if (exposure.fault == "black") {
    std::fill_n(out, depth.size(), std::uint16_t{0});
  } else if (exposure.fault == "garbage") {
    std::minstd_rand noise(static_cast<unsigned>(exposure.index) + 1);
    for (std::size_t i = 0; i < depth.size(); ++i) out[i] = static_cast<std::uint16_t>(noise() >> 8);
  } else {
    // Depth in the unit of the mode.
    const int per_count = mode_.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM ? 1 : 10;
    for (std::size_t i = 0; i < depth.size(); ++i)
      out[i] = static_cast<std::uint16_t>((std::min<int>(depth[i], 65534) + per_count / 2) / per_count);
  }

  if (mirrored_)
    for (int v = 0; v < depth.height(); ++v)
      std::reverse(out + depth.index(0, v), out + depth.index(0, v) + depth.width());
}

void Stream::paint_colour(const Exposure& exposure, std::uint8_t* out) const {
  const Image<Rgb>& colour = exposure.picture->colour;
  const bool black = exposure.fault == "black" || exposure.fault == "black_colour";
  for (int v = 0; v < colour.height(); ++v) {
    for (int u = 0; u < colour.width(); ++u, out += 3) {
      const int x = (mirrored_ ? colour.width() - 1 - u : u) - exposure.colour_shift;
      const Rgb pixel = black || !colour.contains(x, v) ? Rgb{} : colour.at(x, v);
      std::memcpy(out, &pixel, 3);
    }
  }
}

}  // namespace barehand::virtual_openni
