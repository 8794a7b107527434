#pragma once

#include <array>

#include "hand/segments.h"
#include "math/se3.h"

namespace barehand {

/// Normal equations H x = g over the 96 unknowns of the hand's pose. H has blocks only for segments and between a
/// segment and its parent, so it is a Gaussian on the hand's tree. Solving it is Gaussian belief propagation (paper
/// Eq. 7, 8 with Gaussian messages): one pass from the fingertips to the palm and one pass back, at a cost linear in
/// the number of segments.
struct GaussianTree {
  std::array<Matrix6d, kSegmentCount> H_self;    ///< diagonal block of each segment; both triangles are filled in
  std::array<Matrix6d, kSegmentCount> H_parent;  ///< block of a segment (rows) and its parent (columns); palm: unused
  std::array<Vector6d, kSegmentCount> g;

  /// Sets all blocks to zero: there are no residuals.
  void set_zero();
  /// Adds residuals r with the information matrix W that depend on the segment `child`, which must not be the palm, and
  /// on its parent.
  template <int N>
  void add(int child, const Eigen::Matrix<double, N, 6>& J_child, const Eigen::Matrix<double, N, 6>& J_parent,
           const Eigen::Matrix<double, N, 1>& r, const Eigen::Matrix<double, N, N>& W) {
    const int parent = parent_of(child);
    H_self[child] += J_child.transpose() * W * J_child;
    H_self[parent] += J_parent.transpose() * W * J_parent;
    H_parent[child] += J_child.transpose() * W * J_parent;
    g[child] -= J_child.transpose() * (W * r);
    g[parent] -= J_parent.transpose() * (W * r);
  }
  /// Computes x. Returns false, and writes nothing, if H is not positive definite or a result is not finite.
  bool solve(std::array<Vector6d, kSegmentCount>& x) const;
  /// Computes the marginal covariances: the diagonal 6x6 blocks of the inverse of H. Fails like solve().
  bool marginals(std::array<Matrix6d, kSegmentCount>& covariance) const;
};

}  // namespace barehand
