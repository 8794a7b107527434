#pragma once

#include <algorithm>

#include "sensor/rgbd_frame.h"

namespace barehand {

/// Smallest fraction of tinted pixels, among those with measured depth, for which a colour image does not count as
/// grey.
inline constexpr double kFewestTinted = 0.01;

/// Whether a colour differs from grey by more than compression may change a grey pixel.
inline bool tinted(Rgb c) {
  constexpr int kGreyTolerance = 6;
  return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}) > kGreyTolerance;
}

/// Whether a frame has a colour image that is not grey, tested on every 64th pixel if its depth was measured.
bool has_colour(const RgbdFrame& frame);

}  // namespace barehand
