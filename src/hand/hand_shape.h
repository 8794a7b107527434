#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "hand/profile.h"
#include "hand/skin.h"

namespace barehand {

/// How a person's hand differs from a mean hand: logarithms of size factors, and shifts of the knuckles. Zero is the
/// mean hand itself.
inline constexpr int kShapeCount = 51;
using HandShape = Eigen::Matrix<double, kShapeCount, 1>;

/// What one number of a HandShape means and how much people differ in it (standard deviation, same unit).
struct ShapeParameter {
  std::string name;
  double deviation = 0;
};
const std::array<ShapeParameter, kShapeCount>& shape_parameters();

/// The mean hand with a person's shape; rest rotations and joint limits stay.
HandProfile reshaped(const HandProfile& mean, const HandShape& shape);

/// First-order change of a hand with its shape.
struct ShapeBasis {
  /// Skin vertices x shape parameters: outward motion of the skin [m per unit].
  Eigen::Matrix<float, Eigen::Dynamic, kShapeCount, Eigen::RowMajor> outward;
  /// 3 x shape parameters: motion of a segment's joint in its parent's frame [m per unit].
  std::array<Eigen::Matrix<double, 3, kShapeCount>, kSegmentCount> joint;
  std::vector<Eigen::Vector3f> normal_in_b;  ///< of every skin vertex, in the frame of its second segment
};
/// At `shape`; `skin` is the skin of reshaped(mean, shape).
ShapeBasis shape_basis(const HandProfile& mean, const HandShape& shape, const Skin& skin);
/// The skin after a small change of the shape, by its basis: much faster than making it anew.
Skin morphed(const Skin& skin, const ShapeBasis& basis, const HandShape& change);

}  // namespace barehand
