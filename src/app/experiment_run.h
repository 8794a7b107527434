#pragma once

#include <string>
#include <vector>

#include "app/experiment_plan.h"
#include "app/experiment_report.h"
#include "app/track_run.h"

namespace barehand {

struct ExperimentOptions {
  std::string out;                       ///< folder to make
  std::vector<std::string> keys;         ///< "key=value" of the simulator (synthetic_spec.h), for every sequence
  std::string hand;                      ///< profile for the tracker; "": as measured on the simulated hand
  std::optional<std::int64_t> frames{};  ///< end every sequence after so many
  bool search_start = false;             ///< find the hand in the first frame; false: start at its true pose
  int threads = 1;
};

/// Renders the plan's sequences, tracks each with every variant, compares with the truth. In `out`:
/// recordings/SEQUENCE; results/SEQUENCE.VARIANT.csv; snapshots/SEQUENCE.VARIANT/, up to eight of the frames with the
/// tracked hand drawn over them; plots/SEQUENCE/ and figures/SEQUENCE.json, as `barehand eval` writes them; then the
/// report (write_experiment). Progress on standard error. Fails at the first thing that goes wrong, or with
/// kExitInterrupted; what was finished until then stays. A wrong hand, key or folder is noticed before anything is
/// written.
tl::expected<ExperimentReport, TrackFailure> run_experiment(const ExperimentPlan& plan,
                                                            const ExperimentOptions& options);

}  // namespace barehand
