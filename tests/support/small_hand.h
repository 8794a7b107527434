#pragma once

#include "hand/profile.h"

namespace barehand::test {

/// A simple right hand with round numbers: the fingers lie side by side, roughly along -z. The root joints flex and
/// abduct, the others only flex.
inline HandProfile small_hand() {
  HandProfile profile;
  for (int s = 0; s < kSegmentCount; ++s) {
    SegmentProfile& segment = profile.segments[s];
    segment.length = s == kPalm ? 0.08 : 0.03;
    segment.distal = {0, 0, -segment.length};
    segment.radius = {0.01, 0.008};
    segment.half_width = {0.011, 0.009};
    segment.half_thickness = {0.0095, 0.007};
    segment.flesh_offset_x = {0.001, -0.002};
    segment.flesh_offset_y = {-0.003, 0};

    // Add a joint to every segment but the palm.
    if (s == kPalm) continue;
    const int joint = (s - 1) % 3;
    segment.T_hand_segment.t = {-0.03 + 0.015 * finger_of(s), 0, -0.08 - 0.03 * joint};
    segment.T_hand_segment.R = exp_so3({0, 0.1 * (2 - finger_of(s)), 0});
    if (joint == 0) segment.dofs.push_back({"abd", Eigen::Vector3d::UnitY(), -0.2, 0.3});
    segment.dofs.push_back({"flex", -Eigen::Vector3d::UnitX(), -0.5, 1.5});
  }
  return profile;
}

}  // namespace barehand::test
