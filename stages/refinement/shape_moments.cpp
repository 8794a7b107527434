// The normal equations of a hand's shape together with its pose.
#include "stages/refinement/shape_moments.h"

#include "hand/joint_linearisation.h"

namespace barehand {

using Eigen::Vector3f;

void ShapeEquations::set_zero() {
  tree.set_zero();
  for (auto& block : H_pose_shape) block.setZero();
  H_shape.setZero();
  g_shape.setZero();
}

bool ShapeEquations::without_pose(Eigen::Matrix<double, kShapeCount, kShapeCount>& information, HandShape& g) const {
  // Start from what does not depend on the pose.
  information = H_shape;
  g = g_shape;
  GaussianTree column = tree;
  std::array<Vector6d, kSegmentCount> x;
  if (!column.solve(x)) return false;

  // Subtract the part of the shape's gradient that a change of the pose explains (Schur complement).
  for (int s = 0; s < kSegmentCount; ++s) g -= H_pose_shape[s].transpose() * x[s];

  // Subtract it from the shape's matrix, too, column by column; one tree is reused for all columns.
  for (int k = 0; k < kShapeCount; ++k) {
    for (int s = 0; s < kSegmentCount; ++s) column.g[s] = H_pose_shape[s].col(k);
    if (!column.solve(x)) return false;
    for (int s = 0; s < kSegmentCount; ++s) information.col(k) -= H_pose_shape[s].transpose() * x[s];
  }
  information = 0.5 * (information + information.transpose()).eval();
  return information.allFinite() && g.allFinite();
}

void ShapeMoments::reset(const HandPose& pose, std::size_t vertices) {
  for (int s = 0; s < kSegmentCount; ++s) origin_[s] = pose[s].t.cast<float>();
  vertices_.assign(vertices, Vertex{});
}

void ShapeMoments::add(const Correspondence& c, const SkinVertex& v, const Vector3f& direction, float r, float w) {
  const float outward = direction.dot(c.normal);
  const auto row = [&](int s) { return (Row() << direction, (c.model - origin_[s]).cross(direction)).finished(); };
  Vertex& sums = vertices_[c.vertex];
  sums.shape += w * outward * outward;
  sums.gradient += w * outward * r;
  sums.a += w * outward * (1 - v.weight_b) * row(v.a);
  if (v.weight_b > 0) sums.b += w * outward * v.weight_b * row(v.b);
}

void ShapeMoments::add_to(const Skin& skin, const ShapeBasis& basis, ShapeEquations& equations) const {
  Eigen::Matrix<float, Eigen::Dynamic, kShapeCount, Eigen::RowMajor> weighted(basis.outward.rows(), kShapeCount);
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vertex& sums = vertices_[i];
    const auto outward = basis.outward.row(static_cast<Eigen::Index>(i));
    weighted.row(static_cast<Eigen::Index>(i)) = sums.shape * outward;
    if (sums.shape == 0) continue;
    equations.g_shape -= (sums.gradient * outward).transpose().cast<double>();
    equations.H_pose_shape[skin.vertices[i].a] += (sums.a * outward).cast<double>();
    if (skin.vertices[i].weight_b > 0) equations.H_pose_shape[skin.vertices[i].b] += (sums.b * outward).cast<double>();
  }
  equations.H_shape += (basis.outward.transpose() * weighted).cast<double>();
}

void add_joint_shape(const HandProfile& profile, const HandPose& pose, const ShapeBasis& basis, double sigma_gap,
                     ShapeEquations& equations) {
  const double w = 1 / (sigma_gap * sigma_gap);
  for (int s = 1; s < kSegmentCount; ++s) {
    const int parent = parent_of(s);
    const JointLinearisation joint = linearise_joint(profile, pose, s);
    const Eigen::Matrix<double, 3, kShapeCount> moved = pose[parent].R * basis.joint[s];
    equations.H_shape += w * moved.transpose() * moved;
    equations.g_shape -= w * moved.transpose() * joint.gap;
    equations.H_pose_shape[s].topRows<3>() -= w * moved;
    equations.H_pose_shape[parent].topRows<3>() += w * moved;
    equations.H_pose_shape[parent].bottomRows<3>() += w * skew(joint.lever) * moved;
  }
}

}  // namespace barehand
