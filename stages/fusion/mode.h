#pragma once

#include <vector>

#include "hand/samples.h"

namespace barehand {

/// Selects samples of high belief that differ from each other. An object keeps its buffers between calls but no other
/// state.
class DistinctChoice {
 public:
  /// Indices of at most `count` samples in the order of decreasing belief; of equal beliefs the lower index comes
  /// first. A sample is left out if it lies within `separation` half widths of an earlier choice on every axis of that
  /// choice's frame. Valid until the next call.
  const std::vector<std::size_t>& best(const std::vector<SE3>& poses, const std::vector<double>& log_belief, int count,
                                       const Vector6d& half_width, double separation);

 private:
  std::vector<std::size_t> order_, chosen_;
};

/// Belief-weighted mean of the samples within `radius` [m] and `angle` [rad] of the best sample.
SE3 mode_mean(const std::vector<SE3>& poses, const std::vector<double>& log_belief, double radius, double angle);

/// Second moment of the samples under the belief around `centre`, in boxplus coordinates of the camera frame.
Matrix6d belief_covariance(const std::vector<SE3>& poses, const std::vector<double>& log_belief, const SE3& centre);

}  // namespace barehand
