// Opens an OpenNI2 sensor or .oni file, and reads its streams.
#include "drivers/openni2/sensor.h"

#include <array>
#include <cmath>

#include "drivers/openni2/frames/video_modes.h"
#include "drivers/openni2/library.h"
#include "sensor/camera_limits.h"

namespace barehand {
namespace {

// Largest relative difference of fx and fy; if they differ more, the field of view belongs to another mode.
constexpr double kMostPixelStretch = 0.05;
constexpr const char* kGiveIntrinsics =
    "give fx, fy, cx and cy in the configuration's openni2 group; record and convert take --fx --fy --cx --cy";

}  // namespace

Result<std::unique_ptr<OpenNiSensor>> OpenNiSensor::open(const std::string& where, const OpenNiParams& params) {
  std::unique_ptr<OpenNiSensor> sensor(new OpenNiSensor(where, params));
  auto opened = sensor->open_device().and_then([&] { return sensor->create_depth(); });
  if (opened && params.colour != "never") sensor->create_colour();
  if (opened) opened = sensor->choose_intrinsics().and_then([&] { return sensor->start(); });
  if (!opened) return tl::unexpected(opened.error());
  return sensor;
}

OpenNiSensor::~OpenNiSensor() {
  for (openni::VideoStream* stream : {&depth_, &colour_})
    if (stream->isValid()) stream->stop();
  if (playback_) {
    static_cast<void>(handles_.release());
    return;
  }
  depth_.destroy();
  colour_.destroy();
  device_.close();
}

Result<void> OpenNiSensor::open_device() {
  if (device_.open(where_.c_str()) != openni::STATUS_OK)
    return fail("cannot be opened: " + openni_error(), where_,
                unless_file("does another program use it? does this user have permission to open it (deploy/udev)?"));
  playback_ = device_.getPlaybackControl();
  if (!playback_) return {};
  playback_->setRepeatEnabled(false);
  if (playback_->setSpeed(-1) != openni::STATUS_OK)  // -1: images are delivered one by one, on request
    return fail("cannot be played frame by frame: " + openni_error(), where_, "record it again");
  return {};
}

std::string OpenNiSensor::unless_file(const char* remedy) const { return where_.starts_with('/') ? "" : remedy; }

Result<void> OpenNiSensor::create_depth() {
  // Create the stream.
  if (!device_.hasSensor(openni::SENSOR_DEPTH) || depth_.create(device_, openni::SENSOR_DEPTH) != openni::STATUS_OK)
    return fail("has no depth: " + openni_error(), where_,
                unless_file("choose a depth camera: barehand doctor lists them"));

  // Choose the mode; a file has only one.
  if (!playback_) {
    const auto mode = choose_depth_mode(depth_.getSensorInfo(), params_);
    if (mode && depth_.setVideoMode(*mode) != openni::STATUS_OK)
      shortfalls_.push_back("rejects the mode " + to_text(*mode) + " that it offers: " + openni_error());
    if (depth_.isCroppingSupported()) depth_.resetCropping();
  }

  // Check the mode that the stream really has.
  depth_mode_ = depth_.getVideoMode();
  if (depth_unit(depth_mode_.getPixelFormat()) == 0)
    return fail("its depth format " + std::to_string(depth_mode_.getPixelFormat()) + " is not known", where_,
                unless_file("use a sensor or a mode with depth in millimetres or tenths"));

  // Report it if that is not the requested mode.
  const bool as_wanted =
      playback_ || (depth_mode_.getResolutionX() == params_.width && depth_mode_.getResolutionY() == params_.height &&
                    depth_mode_.getFps() == params_.fps);
  if (!as_wanted)
    shortfalls_.push_back("has no depth of " + std::to_string(params_.width) + "x" + std::to_string(params_.height) +
                          " at " + std::to_string(params_.fps) + " Hz; it runs " + to_text(depth_mode_));
  unmirror(depth_, depth_mirrored_, "depth");
  return {};
}

void OpenNiSensor::create_colour() {
  // Create the stream; a sensor may have no colour, or fail to create the stream.
  if (!device_.hasSensor(openni::SENSOR_COLOR)) {
    shortfalls_.push_back("has no colour: skin and objects are distinguished by depth alone");
    return;
  }
  if (colour_.create(device_, openni::SENSOR_COLOR) != openni::STATUS_OK) return drop_colour(openni_error());
  has_colour_ = true;

  // Choose a mode of the depth image's size.
  if (!playback_) {
    const auto mode = choose_colour_mode(colour_.getSensorInfo(), depth_mode_);
    if (!mode) return drop_colour("it has no mode of the depth image's size");
    if (colour_.setVideoMode(*mode) != openni::STATUS_OK) return drop_colour(openni_error());
    if (colour_.isCroppingSupported()) colour_.resetCropping();
  }

  // Check the mode that the stream really has.
  colour_mode_ = colour_.getVideoMode();
  const bool fits = colour_mode_.getResolutionX() == depth_mode_.getResolutionX() &&
                    colour_mode_.getResolutionY() == depth_mode_.getResolutionY();
  if (!fits) return drop_colour("it is not of the depth image's size");
  if (colour_bytes_per_pixel(colour_mode_.getPixelFormat()) == 0) return drop_colour("its format is not known");

  unmirror(colour_, colour_mirrored_, "colour");
  register_colour();
}

void OpenNiSensor::register_colour() {
  if (playback_) {  // a file does not state whether its colour is registered, so it is used as recorded
    registered_ = true;
    return;
  }
  constexpr auto kMode = openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  if (device_.isImageRegistrationModeSupported(kMode)) device_.setImageRegistrationMode(kMode);
  registered_ = device_.getImageRegistrationMode() == kMode;
  if (registered_) return;
  if (params_.colour == "registered") return drop_colour("the sensor does not register it to depth");
  shortfalls_.push_back(
      "does not confirm that colour is registered to depth; it is used nevertheless (openni2.colour: always)");
}

void OpenNiSensor::drop_colour(const std::string& why) {
  has_colour_ = false;
  if (colour_.isValid() && !playback_) colour_.destroy();
  shortfalls_.push_back("colour is not used: " + why);
}

void OpenNiSensor::unmirror(openni::VideoStream& stream, bool& mirrored, const char* name) {
  if (!playback_ && stream.getMirroringEnabled()) stream.setMirroringEnabled(false);
  mirrored = stream.getMirroringEnabled();
  if (mirrored && !playback_)
    shortfalls_.push_back(std::string("delivers ") + name + " only mirrored; it is mirrored back here");
}

Result<void> OpenNiSensor::choose_intrinsics() {
  // Use the intrinsics that the user has given, if any.
  const int width = depth_mode_.getResolutionX(), height = depth_mode_.getResolutionY();
  camera_ = params_.camera.of_size(width, height);
  if (params_.camera.any()) {
    if (plausible(camera_)) return {};
    return fail("does not match the given fx, fy, cx and cy", where_, "give them in pixels of its depth image");
  }

  // Otherwise compute them from the field of view. Depth that is registered to colour has the colour camera's
  // intrinsics.
  openni::VideoStream& eye = has_colour() && registered_ && !playback_ ? colour_ : depth_;
  camera_.fx = width / 2.0 / std::tan(eye.getHorizontalFieldOfView() / 2.0);
  camera_.fy = height / 2.0 / std::tan(eye.getVerticalFieldOfView() / 2.0);
  camera_.cx = (width - 1) / 2.0;
  camera_.cy = (height - 1) / 2.0;

  // Refuse or report implausible values.
  if (!plausible(camera_)) return fail("does not report its field of view", where_, kGiveIntrinsics);
  if (std::abs(camera_.fx / camera_.fy - 1) > kMostPixelStretch)
    shortfalls_.push_back("reports fields of view that imply non-square pixels (fx " + std::to_string(camera_.fx) +
                          ", fy " + std::to_string(camera_.fy) + "); " + kGiveIntrinsics);
  return {};
}

Result<void> OpenNiSensor::start() {
  if (depth_.start() != openni::STATUS_OK)
    return fail("the depth stream cannot be started: " + openni_error(), where_,
                unless_file("reconnect the sensor to a port that no other device shares"));
  if (has_colour() && colour_.start() != openni::STATUS_OK) drop_colour("it cannot be started: " + openni_error());
  // OpenNI2 pairs streams only when both run. A file is paired by its time stamps instead.
  if (has_colour() && !playback_ && !pair_streams(true))
    shortfalls_.push_back("does not synchronise depth and colour; they are paired by time stamp");
  return {};
}

bool OpenNiSensor::pair_streams(bool wanted) {
  // Use the status of this call: asked later, OpenNI2 claims that the streams are paired even if the driver refused.
  paired_ = device_.setDepthColorSyncEnabled(wanted) == openni::STATUS_OK && wanted;
  return paired_;
}

std::optional<OpenNiSensor::Picture> OpenNiSensor::read(std::chrono::milliseconds patience) {
  std::array<openni::VideoStream*, 2> streams{&depth_, &colour_};
  int ready = -1;
  const auto status = openni::OpenNI::waitForAnyStream(streams.data(), has_colour() ? 2 : 1, &ready,
                                                       static_cast<int>(patience.count()));
  if (status != openni::STATUS_OK || ready < 0) return std::nullopt;
  Picture picture;
  picture.colour = ready == 1;
  if (streams[static_cast<std::size_t>(ready)]->readFrame(&picture.frame) != openni::STATUS_OK) return std::nullopt;
  return picture;
}

std::string OpenNiSensor::description() const {
  const openni::DeviceInfo& info = device_.getDeviceInfo();
  std::string text =
      std::string(info.getVendor()) + " " + info.getName() + " at " + where_ + ": " + to_text(depth_mode_);
  text += depth_unit(depth_mode_.getPixelFormat()) < 5e-4 ? ", 0.1 mm" : ", 1 mm";
  if (!has_colour()) return text + ", no colour";
  text += registered_ ? ", colour registered" : ", colour not registered";
  return text + (paired() ? ", synchronised" : ", not synchronised");
}

}  // namespace barehand
