#pragma once

#include <vector>

#include <Eigen/Core>

namespace barehand {

/// A map of logits, row-major.
struct HeatMap {
  const float* logit;
  int width, height;
};

struct HeatPeak {
  int column = 0, row = 0;
  double probability = 0;
};

/// Cells that are the highest among their eight neighbours and more probable than `least`, the most probable first;
/// of equals the first in the map.
std::vector<HeatPeak> find_peaks(const HeatMap& map, double least);

/// The distribution over the cells that a map stands for (softmax), summed up.
struct HeatMoments {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();        ///< column, row [cells]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< [cells^2]
  double value_mean = 0, value_variance = 0;             ///< of a second map, weighted with the first
};
HeatMoments heat_moments(const HeatMap& map, const float* values);

}  // namespace barehand
