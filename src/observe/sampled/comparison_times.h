#pragma once

#include <string>

#include "core/clock.h"
#include "observe/sampled/observer.h"

namespace barehand {

/// How long one call of each observer takes with the same batch [s].
struct ComparisonTimes {
  double cpu = 0, device = 0;

  bool device_is_faster() const { return device < cpu; }
};

/// Text such as "a call takes 0.29 ms on the CPU and 0.12 ms on the device, which is 2.4 times as fast".
std::string to_text(const ComparisonTimes& times);

/// Returns the median times of several calls of both observers, after one call of each that is not measured. The device
/// receives the map again in every call, as for the first search level of a frame. `distances` gets the CPU's results,
/// even if the device fails. Error: the device fails.
Result<ComparisonTimes> time_comparison(const SampleBatch& batch, Observer& cpu, DeviceObserver& device,
                                        const Clock& clock, PatchDistances& distances);

}  // namespace barehand
