#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/image.h"
#include "math/camera.h"

namespace barehand {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

/// One measurement of a depth camera. Immutable once shared.
struct RgbdFrame {
  std::int64_t utime = 0;      ///< capture time of the depth image, microseconds since the epoch
  std::int64_t number = 0;     ///< frame number in the recording, or the sensor's sequence number
  std::string sensor;          ///< name of the sensor, "" where there is only one
  Intrinsics camera;           ///< of depth and colour alike: colour is registered to depth
  double depth_unit = 0.001;   ///< metres per depth count
  Image<std::uint16_t> depth;  ///< counts; 0 = no measurement
  Image<Rgb> colour;           ///< empty: no colour. Pure black = no colour at this pixel.
  std::string colour_fault;    ///< why colour that was expected is not there; "": nothing to say
};
using FramePtr = std::shared_ptr<const RgbdFrame>;

}  // namespace barehand
