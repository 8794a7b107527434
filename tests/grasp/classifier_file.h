#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "hand/grasps/frame_grasps.h"
#include "stages/grasp/grasp_features.h"

namespace barehand::test {

/// Inputs of the network of a classifier.
inline constexpr int kClassifierInputs = kGraspFeatureCount + kGraspAngleCount;

/// The file of a classifier whose class 1 (wrap) scores `weight` times the hyperbolic tangent of one input, everything
/// else 0.
inline nlohmann::json classifier_file(int input, double weight) {
  nlohmann::json json = {{"interface", 2}, {"memory", 0.3}};
  json["classes"] = {"none"};
  for (const GraspType& type : grasp_types()) json["classes"].push_back(type.name);
  json["mean"] = std::vector<double>(kClassifierInputs, 0.0);
  json["deviation"] = std::vector<double>(kClassifierInputs, 1.0);

  // One hidden unit, which sees this input.
  std::vector<double> hidden(kClassifierInputs, 0.0);
  hidden[static_cast<std::size_t>(input)] = 1;
  json["hidden_weights"] = hidden;
  json["hidden_bias"] = {0.0};
  std::vector<double> weights(kGraspCount, 0.0);
  weights[1] = weight;
  json["weights"] = weights;
  json["bias"] = std::vector<double>(kGraspCount, 0.0);
  json["touches"] = std::vector<double>(kGraspCount * kGraspPartCount * 3, 0.0);
  return json;
}

}  // namespace barehand::test
