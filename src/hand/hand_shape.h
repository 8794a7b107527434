#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "hand/profile.h"
#include "hand/skin.h"

namespace barehand {

/// The shape of a person's hand relative to the mean hand, the average of many people: logarithms of size factors,
/// shifts of the flesh relative to the thickness, and shifts of the knuckles [m]. Zero is the mean hand.
inline constexpr int kShapeCount = 51;
using HandShape = Eigen::Matrix<double, kShapeCount, 1>;

/// Name of one component of a HandShape and its standard deviation between people, in the unit of the component.
struct ShapeParameter {
  std::string name;
  double deviation = 0;
};
/// The meaning of all components, in the order of HandShape.
const std::array<ShapeParameter, kShapeCount>& shape_parameters();

/// Applies a shape to the mean hand; rest rotations and joint limits stay the same.
HandProfile reshaped(const HandProfile& mean, const HandShape& shape);

/// First-order change of a hand's skin and joints with its shape.
struct ShapeBasis {
  /// Rows: skin vertices; columns: shape components. Outward motion of the skin [m per unit].
  Eigen::Matrix<float, Eigen::Dynamic, kShapeCount, Eigen::RowMajor> outward;
  /// Columns: shape components. Motion of each segment's joint in its parent's frame [m per unit].
  std::array<Eigen::Matrix<double, 3, kShapeCount>, kSegmentCount> joint;
  std::vector<Eigen::Vector3f> normal_in_b;  ///< normal of every skin vertex in the frame of its second segment
};
/// Computes the first-order change at `shape`; `skin` must be the skin of reshaped(mean, shape).
ShapeBasis shape_basis(const HandProfile& mean, const HandShape& shape, const Skin& skin,
                       const std::stop_token& stop = {});
/// The skin after the small change `change` of the shape, to first order: much faster than rebuilding it.
Skin morphed(const Skin& skin, const ShapeBasis& basis, const HandShape& change);

}  // namespace barehand
