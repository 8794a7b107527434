#pragma once

#include <cstdint>
#include <memory>

#include "core/log.h"
#include "core/parallel/parallel.h"
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
};

}  // namespace barehand
