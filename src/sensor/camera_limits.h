#pragma once

#include <cstdint>

#include "math/camera.h"

namespace barehand {

/// Largest focal length and distance of the principal point [px] that is believed of a camera from outside.
inline constexpr double kLargestFocal = 1e5;

/// Largest image that is believed [pixels]: a larger size in a message or a file is a lie or damage.
inline constexpr std::int64_t kMaxPixels = 4096 * 4096;

inline bool possible_size(std::int64_t width, std::int64_t height) {
  return width > 0 && height > 0 && width <= kMaxPixels && height <= kMaxPixels && width * height <= kMaxPixels;
}

/// What a camera can have; NaN is not. Files and messages are held to it, so that rays and pixels stay numbers.
inline bool plausible(const Intrinsics& camera) {
  const auto focal = [](double f) { return f >= 1 && f <= kLargestFocal; };
  const auto centre = [](double c) { return c >= -kLargestFocal && c <= kLargestFocal; };
  return possible_size(camera.width, camera.height) && focal(camera.fx) && focal(camera.fy) && centre(camera.cx) &&
         centre(camera.cy);
}

}  // namespace barehand
