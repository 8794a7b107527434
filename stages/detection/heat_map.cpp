// Finds the peaks of a network's heat map.
#include "stages/detection/heat_map.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

bool is_peak(const HeatMap& map, int column, int row) {
  const float own = map.logit[row * map.width + column];
  for (int r = std::max(0, row - 1); r <= std::min(map.height - 1, row + 1); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(map.width - 1, column + 1); ++c) {
      const float other = map.logit[r * map.width + c];
      const bool before = r < row || (r == row && c < column);  // of equal cells, the first one is the peak
      if (before ? other >= own : other > own) return false;
    }
  return true;
}

}  // namespace

std::vector<HeatPeak> find_peaks(const HeatMap& map, double least) {
  std::vector<HeatPeak> peaks;
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      const double probability = 1 / (1 + std::exp(-static_cast<double>(map.logit[row * map.width + column])));
      if (probability > least && is_peak(map, column, row)) peaks.push_back({column, row, probability});
    }
  std::ranges::stable_sort(peaks, std::greater<>(), &HeatPeak::probability);
  return peaks;
}

HeatMoments heat_moments(const HeatMap& map, const float* values) {
  const int count = map.width * map.height;
  const double highest = *std::max_element(map.logit, map.logit + count);
  double total = 0, value_square = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  HeatMoments moments;

  // Add up the moments, weighted by the probabilities.
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      const int i = row * map.width + column;
      const double p = std::exp(map.logit[i] - highest);
      const Eigen::Vector2d cell(column, row);

      total += p;
      sum += p * cell;
      squares += p * cell * cell.transpose();
      moments.value_mean += p * values[i];
      value_square += p * values[i] * values[i];
    }

  // Normalise the sums.
  moments.mean = sum / total;
  moments.covariance = squares / total - moments.mean * moments.mean.transpose();
  moments.value_mean /= total;
  moments.value_variance = std::max(0.0, value_square / total - moments.value_mean * moments.value_mean);
  return moments;
}

}  // namespace barehand
