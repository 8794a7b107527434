#pragma once

#include <string>
#include <vector>

#include "app/eval/eval_report.h"

namespace barehand {

// The results of an experiment, and their output.

/// The result of one variant on one sequence.
struct ExperimentRow {
  std::string sequence;
  EvaluatedRun run;                        ///< labelled with the variant
  double preprocess_ms = 0, track_ms = 0;  ///< mean time per frame in these stages [ms]
};

/// The results of a whole experiment.
struct ExperimentReport {
  std::string name;  ///< name of the experiment
  std::vector<ExperimentRow> rows;
};

/// A text table with one line per row: numbers of frames and lost frames, errors [mm], times [ms].
std::string experiment_table(const ExperimentReport& report);
/// Writes the report to DIRECTORY/NAME.txt, .csv and .json, and draws the errors as boxes per sequence and variant
/// (paper Fig. 7) in DIRECTORY/NAME.png. Errors: a file that cannot be written, for example because the disk is full.
Result<void> write_experiment(const ExperimentReport& report, const std::string& directory);

}  // namespace barehand
