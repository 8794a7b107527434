// Smooths the published pose of a hand over time.
#include "stages/publish/pose_smoother.h"

#include <cmath>

namespace barehand {

void PoseSmoother::reset() {
  started_ = false;
  for (OneEuroPose& filter : filters_) filter.reset();
}

HandPose PoseSmoother::smooth(const HandPose& raw, std::int64_t utime, const OneEuroParams& params) {
  // Restart the filters after a gap.
  constexpr double kLongestGap = 1.0;                                      // longest gap between two poses [s]
  const double dt = std::abs(1e-6 * static_cast<double>(utime - utime_));  // a replay may run backwards
  if (!params.enabled || (started_ && (dt == 0 || dt > kLongestGap))) reset();
  if (!params.enabled) return raw;
  started_ = true;
  utime_ = utime;

  // Filter the palm, and the other segments relative to their parents.
  HandPose smoothed;
  smoothed[kPalm] = filters_[kPalm].filter(raw[kPalm], dt, params);
  for (int s = 1; s < kSegmentCount; ++s) {
    const int parent = parent_of(s);
    smoothed[s] = smoothed[parent] * filters_[s].filter(raw[parent].inverse() * raw[s], dt, params);
  }
  return smoothed;
}

}  // namespace barehand
