#include "math/mesh_distance.h"

#include <gtest/gtest.h>

#include "math/random.h"

namespace barehand {
namespace {

using Eigen::Vector3d;

/// A cube with an edge length of 2 about `centre`, with every face in two triangles.
struct Cube {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<MeshDistance::Triangle> triangles;

  void add(const Eigen::Vector3f& centre) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (int i = 0; i < 8; ++i)
      vertices.push_back(centre + Eigen::Vector3f(i & 1 ? 1.f : -1.f, i & 2 ? 1.f : -1.f, i & 4 ? 1.f : -1.f));
    for (const MeshDistance::Triangle& t : std::initializer_list<MeshDistance::Triangle>{{0, 2, 3},
                                                                                         {0, 3, 1},
                                                                                         {4, 5, 7},
                                                                                         {4, 7, 6},
                                                                                         {0, 1, 5},
                                                                                         {0, 5, 4},
                                                                                         {2, 6, 7},
                                                                                         {2, 7, 3},
                                                                                         {0, 4, 6},
                                                                                         {0, 6, 2},
                                                                                         {1, 3, 7},
                                                                                         {1, 7, 5}})
      triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
};

double cube_distance(const Vector3d& p) {
  const Vector3d d = p.cwiseAbs() - Vector3d::Ones();
  return std::min(d.maxCoeff(), 0.0) + d.cwiseMax(0).norm();
}

TEST(MeshDistance, IsThatOfTheSolidEverywhere) {
  Cube cube;
  cube.add(Eigen::Vector3f::Zero());
  const MeshDistance mesh(cube.vertices, cube.triangles);
  KeyedRandom random(1, 2, 3, 4);
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
    EXPECT_NEAR(mesh.signed_distance(p), cube_distance(p), 1e-9) << p.transpose();
  }
}

TEST(MeshDistance, NamesTheNearestPlace) {
  Cube cube;
  cube.add(Eigen::Vector3f::Zero());
  const MeshDistance mesh(cube.vertices, cube.triangles);
  const auto nearest = mesh.nearest({0.3, -0.2, 1.5});
  EXPECT_NEAR((nearest.point - Vector3d(0.3, -0.2, 1)).norm(), 0, 1e-12);

  // The barycentric coordinates give the same place.
  Vector3d place = Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    place += nearest.weights[k] * cube.vertices[cube.triangles[nearest.triangle][k]].cast<double>();
  EXPECT_NEAR((place - nearest.point).norm(), 0, 1e-6);
}

TEST(MeshDistance, KnowsTheInsideOfOverlappingPartsAndOfASurfaceWithAHole) {
  Cube cubes;
  cubes.add(Eigen::Vector3f::Zero());
  cubes.add({1.5f, 0, 0});
  const MeshDistance both(cubes.vertices, cubes.triangles);
  EXPECT_TRUE(both.inside({0.8, 0.1, 0.2}));  // in both parts
  EXPECT_TRUE(both.inside({2.2, 0.1, 0.2}));
  EXPECT_FALSE(both.inside({2.6, 0.1, 0.2}));

  // Take one of twelve triangles away.
  Cube open;
  open.add(Eigen::Vector3f::Zero());
  open.triangles.pop_back();
  const MeshDistance hole(open.vertices, open.triangles);
  EXPECT_TRUE(hole.inside({-0.5, 0, 0}));
  EXPECT_FALSE(hole.inside({-1.1, 0, 0}));
  EXPECT_FALSE(hole.inside({1.2, 0, 0}));
}

TEST(MeshDistance, ADistantPartCountsAsADipoleWithoutChangingTheSign) {
  Cube many;
  for (int i = 0; i < 40; ++i) many.add({3.0f * static_cast<float>(i), 0, 0});
  const MeshDistance mesh(many.vertices, many.triangles);
  for (int i = 0; i < 40; ++i) {
    EXPECT_NEAR(mesh.winding_number({3.0 * i + 0.4, 0.3, -0.6}), 1, 0.05);
    EXPECT_NEAR(mesh.winding_number({3.0 * i + 1.4, 0.3, -0.6}), 0, 0.05);
  }
}

}  // namespace
}  // namespace barehand
