#include "object/half_turns.h"

#include <Eigen/Eigenvalues>
#include <numbers>

namespace barehand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Products of inertia below this fraction of the moments are rounding errors of the vertices.
constexpr double kRounding = 1e-6;

}  // namespace

std::array<SE3, 3> half_turns(const ObjectMesh& mesh) {
  // Integrate 1, x and x x^T over the triangles, whose integrals are polynomials of their corners. Positions are
  // relative to the box's centre, so that an origin far away costs no digits.
  const Vector3d origin = bounding_box(mesh).center().cast<double>();
  double area = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  for (const MeshDistance::Triangle& triangle : mesh.triangles) {
    const auto corner = [&](int k) -> Vector3d { return mesh.vertices[triangle[k]].cast<double>() - origin; };
    const Vector3d a = corner(0), b = corner(1), c = corner(2), sum = a + b + c;
    const double of_triangle = 0.5 * (b - a).cross(c - a).norm();
    area += of_triangle;
    first += of_triangle / 3 * sum;
    second += of_triangle / 12 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }

  // Find the centroid and the principal axes.
  const Vector3d centroid = first / area;
  Matrix3d moments = second / area - centroid * centroid.transpose();
  const double least = kRounding * moments.trace();
  moments = moments.unaryExpr([least](double m) { return std::abs(m) < least ? 0 : m; });
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(moments);

  // Turn about each of them.
  std::array<SE3, 3> turns;
  const Vector3d middle = origin + centroid;
  for (int axis = 0; axis < 3; ++axis) {
    const Matrix3d R = exp_so3(std::numbers::pi * axes.eigenvectors().col(axis));
    turns[axis] = {R, middle - R * middle};
  }
  return turns;
}

}  // namespace barehand
