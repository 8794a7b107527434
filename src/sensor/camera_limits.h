#pragma once

#include <cstdint>

#include "math/camera.h"

namespace barehand {

/// Largest focal length, and largest absolute coordinate of the principal point, that is accepted from files and
/// messages [px].
inline constexpr double kLargestFocal = 1e5;

/// Largest number of pixels that is accepted for an image: a message or file that states more is damaged.
inline constexpr std::int64_t kMaxPixels = 4096 * 4096;

inline bool possible_size(std::int64_t width, std::int64_t height) {
  return width > 0 && height > 0 && width <= kMaxPixels && height <= kMaxPixels && width * height <= kMaxPixels;
}

/// Whether a camera can have these intrinsics; false if any is NaN. The intrinsics in files and messages are checked,
/// so that rays and pixel coordinates are finite.
inline bool plausible(const Intrinsics& camera) {
  const auto focal = [](double f) { return f >= 1 && f <= kLargestFocal; };
  const auto centre = [](double c) { return c >= -kLargestFocal && c <= kLargestFocal; };
  return possible_size(camera.width, camera.height) && focal(camera.fx) && focal(camera.fy) && centre(camera.cx) &&
         centre(camera.cy);
}

}  // namespace barehand
