#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "pipeline/config.h"

namespace barehand {

// The experiments of the paper: their sequences and the variants of the tracker.

/// One configuration of the tracker that an experiment compares with others.
struct ExperimentVariant {
  std::string label;
  Config config;
};

/// The runs of an experiment: every variant tracks every sequence.
struct ExperimentPlan {
  std::string name;                    ///< fist, occlusion, grasp or ablation
  std::vector<std::string> sequences;  ///< names of simulated sequences
  std::vector<ExperimentVariant> variants;
};

/// Names of the paper's experiments (Fig. 6 to 8) and of the ablation.
const std::vector<std::string>& experiment_names();

/// Plans an experiment. `configs`: names as for the option --config of track. Errors: a configuration that cannot be
/// read or is given twice; for the ablation, more or fewer than one configuration.
Result<ExperimentPlan> plan_experiment(const std::string& name, const std::vector<std::string>& configs);

/// The configuration `complete`, followed by copies that each lack one of the additions to the paper's method.
std::vector<ExperimentVariant> ablations(const Config& complete);

}  // namespace barehand
