#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "drivers/openni2/frames/colour_pairing.h"
#include "drivers/openni2/sensor.h"
#include "sensor/frame_source.h"

namespace barehand {

/// Reads an .oni file image by image, in the order of the file and each exactly once, and pairs depth with colour. The
/// file advances only when an image is requested. OpenNiFileSource adds the first frame to play and the step between
/// frames.
class OpenNiFilePlayer {
 public:
  /// Opens a file. Errors: it cannot be read, it is not a recording, or it has no depth.
  static Result<std::unique_ptr<OpenNiFilePlayer>> open(const std::string& path, const OpenNiParams& params);

  /// The next depth image with its colour, as a frame; EndOfStream after the last one.
  SourceEvent next();
  std::int64_t frames() const { return depth_total_; }
  /// The number of the frame that `next` will deliver.
  std::int64_t position() const { return position_; }
  OpenNiSensor& sensor() { return *sensor_; }

 private:
  using Pairing = ColourPairing<openni::VideoFrameRef>;

  OpenNiFilePlayer(std::string path, std::unique_ptr<OpenNiSensor> sensor);
  std::optional<Pairing::Pair> next_pair();
  SourceEvent frame_of(const Pairing::Pair& pair);
  Error error(std::string what, std::string remedy) const;

  const std::string path_;
  std::unique_ptr<OpenNiSensor> sensor_;
  Pairing pairing_;
  const int depth_total_, colour_total_;
  int depth_read_ = 0, colour_read_ = 0;
  std::int64_t position_ = 0;
  std::optional<std::int64_t> first_us_;
};

}  // namespace barehand
