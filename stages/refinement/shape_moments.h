#pragma once

#include <array>
#include <vector>

#include "hand/gaussian_tree.h"
#include "hand/hand_shape.h"
#include "observe/model_comparison.h"

namespace barehand {

/// Normal equations of a hand's shape together with its pose in one frame:
///   tree.H x + H_pose_shape y = tree.g,   H_pose_shape^T x + H_shape y = g_shape
struct ShapeEquations {
  GaussianTree tree;
  std::array<Eigen::Matrix<double, 6, kShapeCount>, kSegmentCount> H_pose_shape;
  Eigen::Matrix<double, kShapeCount, kShapeCount> H_shape;
  HandShape g_shape;

  void set_zero();
  /// What the frame says about the shape alone, whatever the pose: the Schur complement. false: not positive definite.
  bool without_pose(Eigen::Matrix<double, kShapeCount, kShapeCount>& information, HandShape& g) const;
};

/// Sums up residuals per skin vertex, since the shape moves a vertex along its normal only: what thousands of
/// residuals say about fifty numbers then costs one product per vertex.
class ShapeMoments {
 public:
  /// Forgets everything; for a skin with so many vertices.
  void reset(const HandPose& pose, std::size_t vertices);

  /// Residual `r` [m] at the model point of `c` along `direction` with information `w` [1/m^2].
  void add(const Correspondence& c, const SkinVertex& v, const Eigen::Vector3f& direction, float r, float w);

  /// Adds to the equations' shape parts.
  void add_to(const Skin& skin, const ShapeBasis& basis, ShapeEquations& equations) const;

 private:
  using Row = Eigen::Matrix<float, 6, 1>;
  struct Vertex {
    float shape = 0, gradient = 0;
    Row a = Row::Zero(), b = Row::Zero();
  };
  std::array<Eigen::Vector3f, kSegmentCount> origin_;
  std::vector<Vertex> vertices_;
};

/// What joints that stay closed say about the bones' lengths (Eq. 5).
void add_joint_shape(const HandProfile& profile, const HandPose& pose, const ShapeBasis& basis, double sigma_gap,
                     ShapeEquations& equations);

}  // namespace barehand
