#pragma once

#include <array>
#include <vector>

#include "hand/gaussian_tree.h"
#include "hand/hand_shape.h"
#include "observe/dense/model_comparison.h"

namespace barehand {

/// Normal equations of a hand's shape (y) together with its pose (x) in one frame:
///   tree.H x + H_pose_shape y = tree.g,   H_pose_shape^T x + H_shape y = g_shape
struct ShapeEquations {
  GaussianTree tree;
  std::array<Eigen::Matrix<double, 6, kShapeCount>, kSegmentCount> H_pose_shape;
  Eigen::Matrix<double, kShapeCount, kShapeCount> H_shape;
  HandShape g_shape;

  /// Removes all residuals.
  void set_zero();
  /// Eliminates the pose by a Schur complement: what the frame says about the shape alone. Returns false if the
  /// equations of the pose are not positive definite or the result is not finite.
  bool without_pose(Eigen::Matrix<double, kShapeCount, kShapeCount>& information, HandShape& g) const;
};

/// Accumulates residuals per skin vertex. Since the shape moves a vertex along its normal only, thousands of residuals
/// then cost one product per vertex instead of one each for some fifty shape parameters.
class ShapeMoments {
 public:
  /// Starts anew at `pose` for a skin with this number of vertices.
  void reset(const HandPose& pose, std::size_t vertices);

  /// Adds the residual `r` [m] at the model point of `c` along `direction` (camera frame) with the information `w`
  /// [1/m^2].
  void add(const Correspondence& c, const SkinVertex& v, const Eigen::Vector3f& direction, float r, float w);

  /// Adds the sums to the shape's parts of the equations.
  void add_to(const Skin& skin, const ShapeBasis& basis, ShapeEquations& equations) const;

 private:
  using Row = Eigen::Matrix<float, 6, 1>;
  // Sums of the information and of the gradient by the vertex's offset, and the products with its segments' twists.
  struct Vertex {
    float shape = 0, gradient = 0;
    Row a = Row::Zero(), b = Row::Zero();
  };
  std::array<Eigen::Vector3f, kSegmentCount> origin_;
  std::vector<Vertex> vertices_;
};

/// Adds the information about bone lengths that lies in joints staying closed (Eq. 5). `sigma_gap`: standard deviation
/// of a joint gap [m].
void add_joint_shape(const HandProfile& profile, const HandPose& pose, const ShapeBasis& basis, double sigma_gap,
                     ShapeEquations& equations);

}  // namespace barehand
