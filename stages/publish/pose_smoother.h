#pragma once

#include <array>
#include <cstdint>

#include "hand/hand_pose.h"
#include "stages/publish/one_euro.h"

namespace barehand {

/// Smooths a hand pose: the palm in the camera frame, every other segment relative to its parent. Joints that are
/// closed in the raw pose therefore stay closed, which sixteen filters in the camera frame would not achieve.
class PoseSmoother {
 public:
  /// Returns the smoothed pose. The filter restarts, and returns `raw`, after a gap of more than a second or if the
  /// time stamp has not changed (no speed can be computed then).
  HandPose smooth(const HandPose& raw, std::int64_t utime, const OneEuroParams& params);
  void reset();

 private:
  bool started_ = false;
  std::int64_t utime_ = 0;
  std::array<OneEuroPose, kSegmentCount> filters_;
};

}  // namespace barehand
