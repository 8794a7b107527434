#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "hand/skin.h"

namespace barehand {

/// Fits elliptic cross-sections to the skin around a bone. Along the bone their middle and their radius (the mean of
/// half width and half thickness) change linearly. Bone frame [m]; u runs from 0 at the proximal to 1 at the distal
/// end.
class SkinSections {
 public:
  /// Least-squares fit to the vertices that mostly follow `segment`, a bone of `length` [m] along -z. `alone`: only
  /// vertices that follow no other bone are used. None: there are too few such vertices.
  static std::optional<SkinSections> fit(const Skin& skin, int segment, double length, bool alone);
  // The x coordinate of the section's middle, and the section's radius, at u [m].
  double middle_x(double u) const { return fit_[0] + u * fit_[1]; }
  double radius(double u) const { return fit_[4] + u * fit_[5]; }
  /// The vertices that were used, and the derivative of middle_x(0) with respect to the offset of each along its
  /// normal.
  const std::vector<int>& vertices() const { return vertices_; }
  const Eigen::VectorXd& middle_x_per_offset() const { return per_offset_; }

 private:
  SkinSections() = default;
  // Middle x, middle y and radius [m], each as the value at u = 0 and the slope; then (half width - half thickness)
  // / 2.
  Eigen::Matrix<double, 7, 1> fit_;
  std::vector<int> vertices_;
  Eigen::VectorXd per_offset_;
};

}  // namespace barehand
