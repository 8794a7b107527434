#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "hand/grasps/frame_grasps.h"
#include "stages/grasp/grasp_features.h"

namespace barehand::test {

/// The file of a classifier whose class 1 (wrap) scores `weight` times a feature, everything else 0.
inline nlohmann::json classifier_file(int feature, double weight) {
  nlohmann::json json = {{"interface", 1}, {"spread", 1}, {"memory", 0.3}};
  json["classes"] = {"none"};
  for (const GraspType& type : grasp_types()) json["classes"].push_back(type.name);
  json["mean"] = std::vector<double>(kGraspFeatureCount, 0.0);
  json["deviation"] = std::vector<double>(kGraspFeatureCount, 1.0);
  json["bias"] = std::vector<double>(kGraspCount, 0.0);
  std::vector<double> weights(static_cast<std::size_t>(kGraspCount * kGraspFeatureCount), 0.0);
  weights[static_cast<std::size_t>(kGraspFeatureCount + feature)] = weight;
  json["weights"] = weights;
  return json;
}

}  // namespace barehand::test
