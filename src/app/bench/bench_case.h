#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/bench/memory_source.h"
#include "core/statistics.h"
#include "object/known_object.h"
#include "pipeline/config.h"
#include "tracking/two_hand_tracker.h"

namespace barehand {

// One case of `barehand bench`, and its measurement.

// Bytes per megabyte.
inline constexpr double kMegabyte = 1e6;

/// One configuration of `barehand track` that is measured.
struct BenchCase {
  std::string sweep;  ///< parameter that is varied; "": the base case
  double value = 0;   ///< value of that parameter
  Config config;
  int threads = 1;
  int decimate = 1;  ///< only every n-th column and row of the frames is used
};

/// The conditions that all cases of a benchmark share.
struct BenchConditions {
  std::int64_t frames = 0;     ///< frames that are tracked and counted per case
  std::int64_t warm_up = 0;    ///< frames before them, which include the search for the hand
  std::optional<double> rate;  ///< frames per second of a live sensor; none: as fast as possible
  bool inline_stages = false;
  std::string lcm_url;  ///< LCM network to which the states are published and from which they are received
};

/// What is tracked in all cases.
struct BenchScene {
  TwoHandTracker::Profiles hands;
  std::vector<KnownObjectPtr> objects;
};

/// What was measured in one case over all counted frames.
struct BenchResult {
  double seconds = 0;  ///< wall clock time
  double frames_per_second = 0;
  double cpu_seconds_per_frame = 0;
  /// Live runs only: time from the capture of the run's first frame until a pose of every hand is published [s]; none:
  /// it never was.
  std::optional<double> first_pose_seconds;
  double tracked_fraction = 0;      ///< fraction of frames in which all hands are tracked: a lost hand costs less time
  PipelineHealth health;            ///< includes the times of stages and queues
  TimeSummary received;             ///< age of a hand's state when it is received through LCM; live runs only
  std::int64_t frame_bytes = 0;     ///< memory of the stored frames, which is part of the resident memory
  std::int64_t peak_bytes = 0;      ///< largest resident memory
  std::vector<double> resident_mb;  ///< resident memory without the stored frames, at equal steps through the run
};

/// Runs the pipeline of `barehand track` over stored frames. Errors: an LCM network that cannot be opened, a stage
/// that fails, a number of threads that is out of range.
Result<BenchResult> run_case(const BenchCase& bench, const BenchConditions& conditions, const FrameStore& store,
                             const BenchScene& scene);

}  // namespace barehand
