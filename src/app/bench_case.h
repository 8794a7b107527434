#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/config.h"
#include "app/hands_tracker.h"
#include "app/memory_source.h"
#include "core/statistics.h"

namespace barehand {

inline constexpr double kMegabyte = 1e6;  // bytes

/// One way of running that is measured.
struct BenchCase {
  std::string sweep;  ///< parameter that is varied; "": the base case
  double value = 0;   ///< of that parameter
  Config config;
  int threads = 1;
  int decimate = 1;  ///< every n-th pixel and row of the frames
};

/// What all cases of a benchmark share.
struct BenchConditions {
  std::int64_t frames = 0;     ///< frames tracked and counted in a case
  std::int64_t warm_up = 0;    ///< frames before them, with the search for the hand
  std::optional<double> rate;  ///< frames per second of a live sensor; none: as fast as possible
  bool inline_stages = false;
  std::string lcm_url;  ///< where the states are published and received again
};

struct BenchResult {
  double seconds = 0;  ///< wall clock for the counted frames
  double frames_per_second = 0;
  double cpu_seconds_per_frame = 0;
  double tracked_share = 0;         ///< of the counted frames; a lost hand is cheap to track
  PipelineHealth health;            ///< times of the counted frames
  TimeSummary received;             ///< capture to reception of the hand's state through LCM; live runs only
  std::int64_t frame_bytes = 0;     ///< of the stored frames, part of what is resident
  std::int64_t peak_bytes = 0;      ///< largest resident memory
  std::vector<double> resident_mb;  ///< without the stored frames, at equal steps through the run
};

/// Runs the pipeline of `barehand track` over stored frames. Errors: an LCM network that cannot be opened, a stage that
/// fails, an absurd number of threads.
Result<BenchResult> run_case(const BenchCase& bench, const BenchConditions& conditions, const FrameStore& store,
                             const HandsTracker::Profiles& hands);

}  // namespace barehand
