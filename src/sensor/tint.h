#pragma once

#include <algorithm>

#include "sensor/rgbd_frame.h"

namespace barehand {

/// Of those pixels of a colour image that measured depth, the least part that is tinted; else the image is grey.
inline constexpr double kFewestTinted = 0.01;

/// Whether a colour is one, and no grey (with what compression makes of grey).
inline bool tinted(Rgb c) {
  constexpr int kGreyTolerance = 6;
  return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}) > kGreyTolerance;
}

/// Whether a frame has a colour image that is not grey, judged by every 64th pixel that measured depth.
bool has_colour(const RgbdFrame& frame);

}  // namespace barehand
