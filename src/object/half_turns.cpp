#include "object/half_turns.h"

#include <Eigen/Eigenvalues>
#include <numbers>

namespace barehand {

using Eigen::Vector3d;

std::array<SE3, 3> half_turns(std::span<const SurfaceSample> surface) {
  // Find the middle and the principal axes.
  Vector3d middle = Vector3d::Zero();
  for (const SurfaceSample& sample : surface) middle += sample.p.cast<double>() / static_cast<double>(surface.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const SurfaceSample& sample : surface) {
    const Vector3d arm = sample.p.cast<double>() - middle;
    moments += arm * arm.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments);

  // Turn about each of them.
  std::array<SE3, 3> turns;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix3d R = exp_so3(std::numbers::pi * axes.eigenvectors().col(axis));
    turns[axis] = {R, middle - R * middle};
  }
  return turns;
}

}  // namespace barehand
