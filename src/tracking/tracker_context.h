#pragma once

#include <cstdint>
#include <memory>

#include "core/log.h"
#include "core/parallel/parallel.h"
#include "stages/segment_tracker/make_observer.h"
#include "stages/segment_tracker/segment_tracker.h"
#include "tracking/tracker_params.h"

namespace barehand {

/// What the parts of one tracker share. The tracker owns it; a part reads it.
struct TrackerContext {
  TrackerParams params;
  std::uint64_t seed;                   ///< of all random numbers, together with the number of the frame
  Workers& workers;                     ///< outlives the tracker
  std::shared_ptr<spdlog::logger> log;  ///< what a user should know
  std::shared_ptr<Observer> observer;   ///< compares samples with the data; lasts while models change: it may be a GPU

  /// What compares samples under other parameters: the same, unless what concerns it changes.
  std::shared_ptr<Observer> observer_for(const TrackerParams& other) const {
    if (same_observer(params.segment_tracker, other.segment_tracker)) return observer;
    return make_observer(other.segment_tracker, workers, log);
  }
};

}  // namespace barehand
