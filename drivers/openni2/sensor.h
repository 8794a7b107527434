#pragma once

#include <OpenNI.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "drivers/openni2/openni_params.h"
#include "math/camera.h"

namespace barehand {

/// An open OpenNI2 sensor or .oni file with running streams: depth and, if available, colour of the same size. Used by
/// one thread. Closing a sensor takes as long as its driver needs, which is not bounded. A file is only stopped, and
/// its handles live until the end of the process, because OpenNI2's player crashes about once in a hundred times when
/// its streams are destroyed.
class OpenNiSensor {
 public:
  /// `where`: the address of a sensor or the path of a file. Errors: it cannot be opened, has no depth, an unknown
  /// depth format or no intrinsics, or does not start. For a file that OpenNI2 cannot play, Error::remedy is left
  /// empty, and OpenNiFilePlayer fills it in.
  static Result<std::unique_ptr<OpenNiSensor>> open(const std::string& where, const OpenNiParams& params);
  ~OpenNiSensor();
  OpenNiSensor(const OpenNiSensor&) = delete;
  OpenNiSensor& operator=(const OpenNiSensor&) = delete;

  /// An image of one of the streams.
  struct Picture {
    bool colour = false;  ///< whether it is a colour image; false: a depth image
    openni::VideoFrameRef frame;
  };
  /// The next image of any stream; none if nothing arrives within `patience`.
  std::optional<Picture> read(std::chrono::milliseconds patience);

  /// Switches pairing on or off: paired streams deliver depth and colour together, unpaired ones each on its own.
  /// Returns whether the streams are paired afterwards.
  bool pair_streams(bool wanted);

  const std::string& where() const { return where_; }
  bool has_colour() const { return has_colour_; }
  bool paired() const { return paired_; }
  bool mirrored(bool colour) const { return colour ? colour_mirrored_ : depth_mirrored_; }
  const openni::VideoMode& depth_mode() const { return depth_mode_; }
  const openni::VideoMode& colour_mode() const { return colour_mode_; }
  const Intrinsics& camera() const { return camera_; }
  /// For a file: the numbers of images in the depth and the colour stream; 0 for a sensor.
  int depth_pictures() { return playback_ ? playback_->getNumberOfFrames(depth_) : 0; }
  int colour_pictures() { return playback_ && has_colour() ? playback_->getNumberOfFrames(colour_) : 0; }
  /// Text for messages, such as "PrimeSense Sensor at 1d27/0601@1/4: 640x480 at 30 Hz, 0.1 mm, colour registered,
  /// synchronised".
  std::string description() const;
  /// Requested features that are not available, each worded to follow "the sensor".
  const std::vector<std::string>& shortfalls() const { return shortfalls_; }

 private:
  OpenNiSensor(std::string where, const OpenNiParams& params) : where_(std::move(where)), params_(params) {}
  Result<void> open_device();
  // Returns the remedy for a sensor and "" for a file; see open().
  std::string unless_file(const char* remedy) const;
  Result<void> create_depth();
  void create_colour();
  // Aligns colour with depth, or leaves colour out.
  void register_colour();
  void drop_colour(const std::string& why);
  void unmirror(openni::VideoStream& stream, bool& mirrored, const char* name);
  Result<void> choose_intrinsics();
  Result<void> start();

  struct Handles {
    openni::Device device;
    openni::VideoStream depth, colour;
  };

  const std::string where_;
  const OpenNiParams params_;
  std::unique_ptr<Handles> handles_ = std::make_unique<Handles>();
  openni::Device& device_ = handles_->device;
  openni::VideoStream& depth_ = handles_->depth;
  openni::VideoStream& colour_ = handles_->colour;
  openni::PlaybackControl* playback_ = nullptr;  ///< control of a file, owned by the device; null for a sensor
  bool has_colour_ = false, paired_ = false;
  openni::VideoMode depth_mode_, colour_mode_;
  bool registered_ = false, depth_mirrored_ = false, colour_mirrored_ = false;
  Intrinsics camera_;
  std::vector<std::string> shortfalls_;
};

}  // namespace barehand
