#pragma once

#include "core/parallel/parallel.h"
#include "observe/sampled/comparison_times.h"
#include "pipeline/config.h"

namespace barehand {

/// How long it takes to compare the samples of one level with the data.
struct TrialTimes {
  int samples = 0;  ///< number of samples of all segments together
  ComparisonTimes times;
};

/// Measures how fast the CPU and the device compare the first level of a frame, as the tracker would do it with this
/// configuration but with `per_segment` samples. The frame shows the shipped hand, flat and half a metre before an
/// ideal camera of 640x480 pixels. Errors: those of loading the hand's file, and of the device.
Result<TrialTimes> time_trial_level(const Config& config, int per_segment, DeviceObserver& device, Workers& workers);

}  // namespace barehand
