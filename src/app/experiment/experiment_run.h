#pragma once

#include <string>
#include <vector>

#include "app/experiment/experiment_plan.h"
#include "app/experiment/experiment_report.h"
#include "app/track/track_run.h"

namespace barehand {

/// Settings of a run of `barehand experiment`.
struct ExperimentOptions {
  std::string out;                       ///< folder to create
  std::vector<std::string> keys;         ///< "key=value" for the simulator (synthetic_spec.h), used for every sequence
  std::string hand;                      ///< profile for the tracker; "": measured on the simulated hand
  std::optional<std::int64_t> frames{};  ///< end every sequence after this many frames
  bool search_start = false;             ///< find the hand in the first frame; false: start at its true pose
  int threads = 1;
  bool overwrite = false;  ///< replace what an earlier experiment left in `out`
};

/// Renders the plan's sequences, tracks each of them with every variant and compares the results with the truth. It
/// writes to the folder `out`:
/// - recordings/SEQUENCE,
/// - results/SEQUENCE.VARIANT.csv,
/// - snapshots/SEQUENCE.VARIANT/, up to eight frames with the tracked hand drawn over them,
/// - plots/SEQUENCE/ and figures/SEQUENCE.json, as `barehand eval` writes them,
/// - the report (write_experiment), and
/// - .experiment, which marks the folder as that of an experiment.
/// A folder that is not empty is refused. With `overwrite`, a folder that an experiment made is accepted: the above is
/// removed from it just before the first rendering, and other files stay.
/// Progress is printed to standard error. The run ends at the first failure, or with kExitInterrupted; what was
/// finished until then stays. A wrong hand, key or folder is reported before anything is written.
tl::expected<ExperimentReport, TrackFailure> run_experiment(const ExperimentPlan& plan,
                                                            const ExperimentOptions& options);

}  // namespace barehand
