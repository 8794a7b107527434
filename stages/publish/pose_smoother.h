#pragma once

#include <array>
#include <cstdint>

#include "hand/hand_pose.h"
#include "stages/publish/one_euro.h"

namespace barehand {

/// Smooths a hand pose: the palm in the camera, every other segment relative to its parent. Joints that are closed in
/// the raw pose stay closed, which sixteen filters in camera coordinates would not keep.
class PoseSmoother {
 public:
  /// Starts anew after a gap of more than a second and where time does not move.
  HandPose smooth(const HandPose& raw, std::int64_t utime, const OneEuroParams& params);
  void reset();

 private:
  bool started_ = false;
  std::int64_t utime_ = 0;
  std::array<OneEuroPose, kSegmentCount> filters_;
};

}  // namespace barehand
