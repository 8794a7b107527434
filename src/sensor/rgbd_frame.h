#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/image.h"
#include "math/camera.h"

namespace barehand {

/// An 8-bit colour.
struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

/// One RGB-D frame of a depth camera. Immutable once shared.
struct RgbdFrame {
  std::int64_t utime = 0;      ///< capture time of the depth image [us since the epoch]
  std::int64_t number = 0;     ///< frame number in the recording, or the sensor's sequence number
  std::string sensor;          ///< name of the sensor; "" if there is only one
  Intrinsics camera;           ///< intrinsics of both images, since colour is registered to depth
  double depth_unit = 0.001;   ///< metres per unit of `depth`
  Image<std::uint16_t> depth;  ///< depth in units of `depth_unit`; 0: no measurement
  Image<Rgb> colour;           ///< colour of every depth pixel, black where it is unknown; empty without a colour image
  std::string colour_fault;    ///< why colour is missing although it was expected; "" otherwise
};
using FramePtr = std::shared_ptr<const RgbdFrame>;

}  // namespace barehand
