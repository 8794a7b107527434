#include "object/half_turns.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/solid_meshes.h"

namespace barehand {
namespace {

using Eigen::Vector3d;

/// A box with its middle at `centre`, turned by `R`.
ObjectMesh moved_box(const Eigen::Vector3f& size, const Eigen::Matrix3d& R, const Vector3d& centre) {
  ObjectMesh mesh = test::box_mesh(size);
  for (auto& v : mesh.vertices) v = (R * v.cast<double>() + centre).cast<float>();
  return mesh;
}

/// The least cosine between an axis of the half turns and the axis of a box's frame that it is nearest to.
double least_cosine(const std::array<SE3, 3>& turns, const Eigen::Matrix3d& R) {
  double least = 1;
  for (const SE3& turn : turns) {
    const Vector3d axis = R.transpose() * log_so3(turn.R).normalized();
    least = std::min(least, axis.cwiseAbs().maxCoeff());
  }
  return least;
}

TEST(HalfTurns, OfABoxAreExact) {
  const Eigen::Matrix3d R = exp_so3({0.4, -0.7, 1.1});
  const Vector3d centre(0.3, -0.2, 0.5);
  const auto turns = half_turns(moved_box({0.10f, 0.06f, 0.03f}, R, centre));
  EXPECT_GT(least_cosine(turns, R), 1 - 1e-9);
  for (const SE3& turn : turns) {
    EXPECT_LT((turn * centre - centre).norm(), 1e-6);
    EXPECT_TRUE((turn * turn).matrix().isIdentity(1e-9));
  }
}

TEST(HalfTurns, DoNotDependOnHowTheSurfaceIsCutIntoTriangles) {
  // Divide one side of the box into many small triangles.
  ObjectMesh mesh = test::box_mesh({0.10f, 0.06f, 0.03f});
  for (int i = 0; i < 500; ++i) {
    const auto [a, b, c] = mesh.triangles.front();
    mesh.triangles.erase(mesh.triangles.begin());
    mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3);
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    for (const auto& triangle : {MeshDistance::Triangle{a, b, middle}, {b, c, middle}, {c, a, middle}})
      mesh.triangles.insert(mesh.triangles.begin(), triangle);
  }
  const auto turns = half_turns(mesh);
  EXPECT_GT(least_cosine(turns, Eigen::Matrix3d::Identity()), 1 - 1e-9);
  for (const SE3& turn : turns) EXPECT_LT(turn.t.norm(), 1e-6);
}

TEST(HalfTurns, OfABoxWithSquareEndsAreAboutItsOwnAxes) {
  for (const Eigen::Vector3f& size : {Eigen::Vector3f(0.10f, 0.03f, 0.03f), Eigen::Vector3f(0.02f, 0.02f, 0.02f)}) {
    const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
    EXPECT_GT(least_cosine(half_turns(moved_box(size, I, {0.1, 0.07, 0.03})), I), 1 - 1e-9) << size.transpose();
  }
}

}  // namespace
}  // namespace barehand
