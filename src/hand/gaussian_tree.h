#pragma once

#include <array>

#include "hand/segments.h"
#include "math/se3.h"

namespace barehand {

/// Normal equations H x = g over the 96 unknowns of the hand, with blocks only on the segments and between a segment
/// and its parent: a Gaussian on the hand's tree. Solving it is Gaussian belief propagation (paper Eq. 7, 8 with
/// Gaussian messages): one pass from the fingertips to the palm, one pass back; cost linear in the segments.
struct GaussianTree {
  std::array<Matrix6d, kSegmentCount> H_self;    ///< symmetric, full
  std::array<Matrix6d, kSegmentCount> H_parent;  ///< rows: segment, columns: its parent; unused for the palm
  std::array<Vector6d, kSegmentCount> g;

  void set_zero();
  /// false (and nothing written) if H is not positive definite or a result is not finite.
  bool solve(std::array<Vector6d, kSegmentCount>& x) const;
  /// Diagonal 6x6 blocks of the inverse of H: the marginal covariances.
  bool marginals(std::array<Matrix6d, kSegmentCount>& covariance) const;
};

}  // namespace barehand
