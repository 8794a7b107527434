#pragma once

#include <spdlog/logger.h>

#include <memory>

#include "core/clock.h"
#include "core/parallel/parallel.h"
#include "observe/sampled/observer.h"
#include "stages/segment_tracker/segment_tracker_params.h"

namespace barehand {

/// The observer that `params.observer` asks for; the CPU where that is not to be had, with a warning if it was asked
/// for by name. `workers` outlives it; `clock` measures which one is faster.
std::unique_ptr<Observer> make_observer(const SegmentTrackerParams& params, Workers& workers,
                                        std::shared_ptr<spdlog::logger> log,
                                        std::shared_ptr<const Clock> clock = std::make_shared<SystemClock>());

/// Whether both ask for the same observer: opening a device takes long, and so does measuring it.
bool same_observer(const SegmentTrackerParams& a, const SegmentTrackerParams& b);

}  // namespace barehand
