#pragma once

#include <array>

#include "hand/segments.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// The colour of a segment in overlays: one for each finger, and light grey for the palm.
inline Rgb finger_colour(int segment) {
  constexpr std::array<Rgb, kFingerCount> kFingers = {
      {{235, 70, 60}, {245, 175, 40}, {80, 205, 80}, {40, 195, 220}, {215, 95, 225}}};
  return segment == kPalm ? Rgb{210, 210, 210} : kFingers[finger_of(segment)];
}

}  // namespace barehand
