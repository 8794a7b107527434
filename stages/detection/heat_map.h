#pragma once

#include <vector>

#include <Eigen/Core>

namespace barehand {

/// A heat map as a network returns it: logits, row-major.
struct HeatMap {
  const float* logit;
  int width, height;
};

/// A local maximum of a heat map; its probability is the logistic function of the logit.
struct HeatPeak {
  int column = 0, row = 0;
  double probability = 0;
};

/// The cells that are higher than their eight neighbours and more probable than `least`, the most probable first. Of
/// neighbouring cells with equal values, the first one in row-major order is the peak.
std::vector<HeatPeak> find_peaks(const HeatMap& map, double least);

/// Moments of the probability distribution over the cells that is the softmax of a heat map.
struct HeatMoments {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();        ///< column, row [cells]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< [cells^2]
  double value_mean = 0, value_variance = 0;             ///< mean and variance of `values` under this distribution
};
/// `values`: a second map of the same size.
HeatMoments heat_moments(const HeatMap& map, const float* values);

}  // namespace barehand
