#pragma once

#include <algorithm>
#include <array>

#include "hand/gaussian_tree.h"
#include "hand/skin.h"

namespace barehand {

/// Factor by which the information of skin near a joint is divided, because the way it folds there is poorly known: 1 +
/// (`folds` w)^2, where w is the smaller of the two segments' skinning weights in `v`.
template <class Scalar>
Scalar fold_penalty(const SkinVertex& v, Scalar folds) {
  const Scalar fold = folds * Scalar(std::min(v.weight_b, 1 - v.weight_b));
  return 1 + fold * fold;
}

/// Accumulates the normal equations of thousands of one-dimensional residuals at points of the skin. The Jacobian row
/// of a residual along direction d at point p is (d, (p - t) x d) for a segment with origin t, times the segment's
/// skinning weight: this costs one outer product of six numbers instead of a 3x6 Jacobian on both sides of a matrix.
/// It computes in single precision, padded to eight lanes; the relative error below 1e-5 is far below the accuracy of
/// depth data.
class ResidualMoments {
 public:
  explicit ResidualMoments(const HandPose& pose) {
    for (int s = 0; s < kSegmentCount; ++s) {
      origin_[s] = pose[s].t.cast<float>();
      self_[s].setZero();
      parent_[s].setZero();
      gradient_[s].setZero();
    }
  }

  /// Adds the residual `r` [m] of the point `p` on the skin at vertex `v` along `direction` with the information `w`
  /// [1/m^2]. `p` and `direction` are in the camera frame.
  void add(const SkinVertex& v, const Eigen::Vector3f& p, const Eigen::Vector3f& direction, float r, float w) {
    const Row a = row(v.a, p, direction, 1 - v.weight_b);
    add_product(self_[v.a], a, a, w);
    gradient_[v.a] += w * r * a;
    if (v.weight_b == 0) return;
    const Row b = row(v.b, p, direction, v.weight_b);
    add_product(self_[v.b], b, b, w);
    gradient_[v.b] += w * r * b;
    if (parent_of(v.a) == v.b)
      add_product(parent_[v.a], a, b, w);
    else
      add_product(parent_[v.b], b, a, w);
  }

  /// Adds all accumulated residuals to the normal equations.
  void add_to(GaussianTree& tree) const;

 private:
  using Row = Eigen::Matrix<float, 8, 1>;
  using Square = Eigen::Matrix<float, 8, 6>;

  // The Jacobian row with respect to the twist of segment s; see the comment of the class.
  Row row(int s, const Eigen::Vector3f& p, const Eigen::Vector3f& d, float skin_weight) const {
    const Eigen::Vector3f turn = (p - origin_[s]).cross(d);
    Row row = Row::Zero();
    row.head<3>() = skin_weight * d;
    row.segment<3>(3) = skin_weight * turn;
    return row;
  }
  static void add_product(Square& sum, const Row& a, const Row& b, float w) {
    const Row wa = w * a;
    for (int k = 0; k < 6; ++k) sum.col(k) += b[k] * wa;
  }

  std::array<Eigen::Vector3f, kSegmentCount> origin_;
  // Sums of J^T w J of each segment with itself (self_), and of each segment (rows) with its parent (columns).
  std::array<Square, kSegmentCount> self_, parent_;
  std::array<Row, kSegmentCount> gradient_;
};

}  // namespace barehand
