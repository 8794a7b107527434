#pragma once

#include "core/parallel/parallel.h"
#include "observe/sampled/comparison_times.h"
#include "pipeline/config.h"

namespace barehand {

/// What comparing one level took.
struct TrialTimes {
  int samples = 0;  ///< of all segments
  ComparisonTimes times;
};

/// Times the first level of a frame as the tracker would compare it with a configuration, but with `per_segment`
/// samples: around the shipped hand, which an ideal camera of 640x480 pixels sees flat at half a metre. Errors: the
/// hand's file, the device's.
Result<TrialTimes> time_trial_level(const Config& config, int per_segment, DeviceObserver& device, Workers& workers);

}  // namespace barehand
