#pragma once

#include <string>
#include <vector>

#include "app/config.h"
#include "core/error.h"

namespace barehand {

/// One way to track that an experiment compares with others.
struct ExperimentVariant {
  std::string label;
  Config config;
};

/// Every variant tracks every sequence.
struct ExperimentPlan {
  std::string name;                    ///< fist, occlusion, grasp or ablation
  std::vector<std::string> sequences;  ///< of the simulator
  std::vector<ExperimentVariant> variants;
};

/// The experiments of the paper (Fig. 6 to 8) and the ablation.
const std::vector<std::string>& experiment_names();

/// `configs`: what track takes as --config. Errors: a configuration that cannot be read or stands there twice; for the
/// ablation, any number of them but one.
Result<ExperimentPlan> plan_experiment(const std::string& name, const std::vector<std::string>& configs);

/// `complete` itself and, one by one, without each of the additions to the paper's method.
std::vector<ExperimentVariant> ablations(const Config& complete);

}  // namespace barehand
