#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "hand/skin.h"

namespace barehand {

/// Elliptic sections across a bone, about a straight line: their middle and their radius, the mean of half width and
/// half thickness, are linear along the bone. In its frame [m]; u goes from 0 where the bone begins to 1 at its end.
class SkinSections {
 public:
  /// Least squares over skin of which most follows `segment`, a bone of `length` [m] along -z. None: too little skin.
  /// `alone`: only what follows no other bone.
  static std::optional<SkinSections> fit(const Skin& skin, int segment, double length, bool alone);
  double middle_x(double u) const { return fit_[0] + u * fit_[1]; }
  double radius(double u) const { return fit_[4] + u * fit_[5]; }
  /// Vertices that were used, and how middle_x(0) changes as each moves along its normal.
  const std::vector<int>& vertices() const { return vertices_; }
  const Eigen::VectorXd& middle_x_per_offset() const { return per_offset_; }

 private:
  SkinSections() = default;
  Eigen::Matrix<double, 7, 1> fit_;  // x, y, radius, each at u = 0 and how it changes, and half of width less thickness
  std::vector<int> vertices_;
  Eigen::VectorXd per_offset_;
};

}  // namespace barehand
