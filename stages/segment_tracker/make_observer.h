#pragma once

#include <spdlog/logger.h>

#include <memory>

#include "core/clock.h"
#include "core/parallel/parallel.h"
#include "observe/sampled/observer.h"
#include "stages/segment_tracker/segment_tracker_params.h"

namespace barehand {

/// Makes the observer that `params.observer` asks for. If its device cannot be opened, the CPU compares the samples; a
/// device that was asked for by name is then reported with a warning. `clock` measures whether the device is faster
/// than the CPU. `workers` must outlive the observer.
std::unique_ptr<Observer> make_observer(const SegmentTrackerParams& params, Workers& workers,
                                        std::shared_ptr<spdlog::logger> log,
                                        std::shared_ptr<const Clock> clock = std::make_shared<SystemClock>());

/// Whether both parameter sets ask for the same observer, so that the present one can be kept: opening and measuring a
/// device takes long.
bool same_observer(const SegmentTrackerParams& a, const SegmentTrackerParams& b);

}  // namespace barehand
