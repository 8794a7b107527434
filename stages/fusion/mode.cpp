// Selects samples of high belief that differ from each other, and averages those near the best one.
#include "stages/fusion/mode.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace barehand {
namespace {

/// Largest offset of b relative to a on any axis of a's frame, in half widths.
double box_distance(const SE3& a, const SE3& b, const Vector6d& half_width) {
  Vector6d offset;
  offset.head<3>() = a.R.transpose() * (b.t - a.t);
  offset.tail<3>() = log_so3(a.R.transpose() * b.R);
  return offset.cwiseQuotient(half_width).cwiseAbs().maxCoeff();
}

}  // namespace

const std::vector<std::size_t>& DistinctChoice::best(const std::vector<SE3>& poses,
                                                     const std::vector<double>& log_belief, int count,
                                                     const Vector6d& half_width, double separation) {
  // Sort by belief.
  order_.resize(poses.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
    return log_belief[a] > log_belief[b] || (log_belief[a] == log_belief[b] && a < b);
  });

  // Take the best samples.
  chosen_.clear();
  for (const std::size_t i : order_) {
    if (static_cast<int>(chosen_.size()) == count) break;

    // The sample must be distinct from all that were chosen before.
    const bool distinct = std::all_of(chosen_.begin(), chosen_.end(), [&](std::size_t k) {
      return box_distance(poses[k], poses[i], half_width) >= separation;
    });
    if (distinct) chosen_.push_back(i);
  }
  return chosen_;
}

SE3 mode_mean(const std::vector<SE3>& poses, const std::vector<double>& log_belief, double radius, double angle) {
  // Average the offsets of the nearby samples from the best one, weighted by their beliefs.
  const std::size_t best = std::max_element(log_belief.begin(), log_belief.end()) - log_belief.begin();
  Vector6d sum = Vector6d::Zero();
  double weights = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vector6d offset = boxminus(poses[i], poses[best]);
    if (offset.head<3>().norm() > radius || offset.tail<3>().norm() > angle) continue;
    const double weight = std::exp(log_belief[i] - log_belief[best]);
    sum += weight * offset;
    weights += weight;
  }
  return boxplus(poses[best], sum / weights);
}

Matrix6d belief_covariance(const std::vector<SE3>& poses, const std::vector<double>& log_belief, const SE3& centre) {
  Matrix6d covariance = Matrix6d::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vector6d offset = boxminus(poses[i], centre);
    covariance += std::exp(log_belief[i]) * offset * offset.transpose();
  }
  return covariance;
}

}  // namespace barehand
