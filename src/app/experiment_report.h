#pragma once

#include <string>
#include <vector>

#include "app/eval_report.h"

namespace barehand {

/// One variant on one sequence.
struct ExperimentRow {
  std::string sequence;
  EvaluatedRun run;                        ///< its label is the variant's
  double preprocess_ms = 0, track_ms = 0;  ///< mean time a frame spent in these stages [ms]
};

struct ExperimentReport {
  std::string name;  ///< of the experiment
  std::vector<ExperimentRow> rows;
};

/// A line per row: frames, lost ones, errors [mm], times.
std::string experiment_table(const ExperimentReport& report);
/// The same as DIRECTORY/NAME.txt, .csv and .json, and its errors as boxes per sequence and variant (paper Fig. 7) in
/// DIRECTORY/NAME.png. A full disk is an error.
Result<void> write_experiment(const ExperimentReport& report, const std::string& directory);

}  // namespace barehand
