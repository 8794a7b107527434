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

/// "a call takes 0.29 ms on the CPU and 0.12 ms on the device, which is 2.4 times as fast".
std::string to_text(const ComparisonTimes& times);

/// Medians of some calls, after one of each that does not count. The device gets the map anew in every one of them, as
/// it does with a frame's first level. `distances`: as the CPU sees them, also where the device fails, which is the
/// error.
Result<ComparisonTimes> time_comparison(const SampleBatch& batch, Observer& cpu, DeviceObserver& device,
                                        const Clock& clock, PatchDistances& distances);

}  // namespace barehand
