#pragma once

#include <array>
#include <vector>

#include "hand/gaussian_tree.h"
#include "hand/hand_shape.h"
#include "observe/dense/model_comparison.h"

namespace barehand {

// Normal equations of a hand's shape together with its pose.

/// Normal equations of a hand's shape (y) together with its pose (x) in one frame:
///   tree.H x + H_pose_shape y = tree.g,   H_pose_shape^T x + H_shape y = g_shape
struct ShapeEquations {
  GaussianTree tree;
  std::array<Eigen::Matrix<double, 6, kShapeCount>, kSegmentCount> H_pose_shape;
  Eigen::Matrix<double, kShapeCount, kShapeCount> H_shape;
  HandShape g_shape;

  /// Sets all blocks to zero: there are no residuals.
  void set_zero();
  /// Eliminates the pose by a Schur complement. What remains is the frame's information about the shape alone. Returns
  /// false if the equations of the pose are not positive definite or the result is not finite.
  bool without_pose(Eigen::Matrix<double, kShapeCount, kShapeCount>& information, HandShape& g) const;
};

/// Accumulates residuals per skin vertex. Because the shape moves a vertex only along its normal, the products with
/// some fifty shape parameters are then computed once per vertex instead of once for each of thousands of residuals.
class ShapeMoments {
 public:
  /// Removes all residuals, and prepares for residuals at `pose` of a skin with this number of vertices.
  void reset(const HandPose& pose, std::size_t vertices);

  /// Adds the residual `r` [m] at the model point of `c` along `direction` (camera frame) with the information `w`
  /// [1/m^2].
  void add(const Correspondence& c, const SkinVertex& v, const Eigen::Vector3f& direction, float r, float w);

  /// Adds the sums to the shape's parts of the equations.
  void add_to(const Skin& skin, const ShapeBasis& basis, ShapeEquations& equations) const;

 private:
  using Row = Eigen::Matrix<float, 6, 1>;
  // Sums of the information and the gradient with respect to the vertex's offset, and the products with its segments'
  // twists.
  struct Vertex {
    float shape = 0, gradient = 0;
    Row a = Row::Zero(), b = Row::Zero();
  };
  std::array<Eigen::Vector3f, kSegmentCount> origin_;
  std::vector<Vertex> vertices_;
};

/// Adds the information about bone lengths that follows from closed joints (paper, Eq. 5). `sigma_gap`: standard
/// deviation of a joint gap [m].
void add_joint_shape(const HandProfile& profile, const HandPose& pose, const ShapeBasis& basis, double sigma_gap,
                     ShapeEquations& equations);

}  // namespace barehand
