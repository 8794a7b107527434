#include "openni2/virtual_device/device.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

namespace barehand::virtual_openni {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr int kUnregisteredShift = 12;  // px, between the cameras
constexpr int kUnsyncedIndex = 3;       // offset of the indices if the cameras count separately
/// Time of the sensor's clock when it is opened [us]; it is unrelated to the host's clock.
constexpr std::int64_t kClockAtOpen = 5'000'000;

}  // namespace

Device::Device(const Pictures& pictures, CurrentSettings settings)
    : pictures_(pictures), settings_(std::move(settings)), at_open_(settings_()) {
  const std::array<OniSensorType, 2> types{ONI_SENSOR_DEPTH, ONI_SENSOR_COLOR};
  for (std::size_t i = 0; i < types.size(); ++i) {
    modes_[i].fill(Stream::best_mode(types[i], pictures.camera(), at_open_->fps));
    if (types[i] == ONI_SENSOR_DEPTH) modes_[i][0].pixelFormat = ONI_PIXEL_FORMAT_DEPTH_1_MM;
    if (types[i] == ONI_SENSOR_DEPTH && at_open_->upright)
      std::swap(modes_[i][1].resolutionX, modes_[i][1].resolutionY);
    sensors_[i] = {types[i], types[i] == ONI_SENSOR_DEPTH ? 2 : 1, modes_[i].data()};
  }
  exposing_ = std::jthread([this](const std::stop_token& stop) { expose_pictures(stop); });
}

Device::~Device() {
  while (settings_()->fault == "hang") std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

OniStatus Device::getSensorInfoList(OniSensorInfo** sensors, int* count) {
  *sensors = sensors_.data();
  *count = at_open_->colour ? 2 : 1;
  return ONI_STATUS_OK;
}

oni::driver::StreamBase* Device::createStream(OniSensorType sensor) {
  if (sensor == ONI_SENSOR_COLOR && !at_open_->colour) return nullptr;
  const std::lock_guard lock(streams_mutex_);
  streams_.push_back(std::make_unique<Stream>(sensor, pictures_.camera(), *at_open_));
  streams_.back()->refuse_start(fault(*settings_()) == "start");
  return streams_.back().get();
}

void Device::destroyStream(oni::driver::StreamBase* stream) {
  const std::lock_guard lock(streams_mutex_);
  std::erase_if(streams_, [stream](const auto& own) { return own.get() == stream; });
}

OniBool Device::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  return mode == ONI_IMAGE_REGISTRATION_OFF || at_open_->registration;
}

OniBool Device::isPropertySupported(int id) { return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION; }

OniStatus Device::setProperty(int id, const void* data, int size) {
  if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || size != sizeof(OniImageRegistrationMode))
    return ONI_STATUS_NOT_SUPPORTED;
  const auto mode = *static_cast<const OniImageRegistrationMode*>(data);
  if (!isImageRegistrationModeSupported(mode)) return ONI_STATUS_NOT_SUPPORTED;
  registered_ = mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR && !at_open_->lies;
  return ONI_STATUS_OK;
}

OniStatus Device::getProperty(int id, void* data, int* size) {
  const OniImageRegistrationMode mode =
      registered_ ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF;
  if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return ONI_STATUS_NOT_SUPPORTED;
  if (*size < static_cast<int>(sizeof mode)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &mode, sizeof mode);
  *size = sizeof mode;
  return ONI_STATUS_OK;
}

void Device::expose_pictures(std::stop_token stop) {
  const auto opened = SteadyClock::now();
  auto due = opened;

  // Wait until the next image is due.
  while (!stop.stop_requested()) {
    const auto now = settings_();
    const auto period = std::chrono::nanoseconds(std::llround(1e9 / now->fps));
    due += period;

    const auto late = SteadyClock::now() - due;
    if (late > period) {  // images that came too late to be exposed are skipped, but their numbers are used
      const auto missed = late / period;
      due += missed * period;
      index_ += static_cast<int>(missed);
    }

    std::this_thread::sleep_until(due + std::chrono::nanoseconds(std::llround(1e9 * now->latency)));
    expose(*now, std::chrono::duration_cast<std::chrono::microseconds>(due - opened).count());
  }
}

std::string Device::fault(const Settings& now) const {
  const bool there_at_open = at_open_->fault == now.fault;
  return now.cured_by_reopen && there_at_open ? "none" : now.fault;
}

void Device::expose(const Settings& now, std::int64_t since_open_us) {
  // A sensor that was unplugged or stalls delivers nothing.
  const std::string trouble = fault(now);
  ++index_;
  unplugged_ |= !now.plugged;
  if (unplugged_ || trouble == "stall" || trouble == "hang") return;
  if (trouble != "frozen" || frozen_at_ < 0) frozen_at_ = index_;

  // What is exposed now.
  Exposure exposure;
  exposure.picture = &pictures_.at(frozen_at_);
  exposure.device_us = static_cast<std::uint64_t>(
      kClockAtOpen + std::llround(static_cast<double>(since_open_us) * (1 + 1e-6 * now.drift_ppm)) +
      now.clock_offset_us);
  exposure.index = index_;
  exposure.fault = trouble;
  exposure.colour_shift = registered_ ? 0 : kUnregisteredShift;

  // Every stream delivers it; unsynchronised cameras count separately.
  const std::lock_guard lock(streams_mutex_);
  for (const auto& stream : streams_) {
    const bool depth = stream->sensor() == ONI_SENSOR_DEPTH;
    exposure.index = depth || at_open_->sync ? index_ : index_ + kUnsyncedIndex;
    if (depth || trouble != "no_colour") stream->deliver(exposure);
  }
}

}  // namespace barehand::virtual_openni
