#pragma once

#include <cmath>
#include <numbers>

#include "object/object_mesh.h"

namespace barehand::test {

/// A box around the origin with these sides [m].
inline ObjectMesh box_mesh(const Eigen::Vector3f& size) {
  ObjectMesh mesh{"box", {}, {}};
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(
        size.cwiseProduct(Eigen::Vector3f(i & 1, i >> 1 & 1, i >> 2 & 1) - Eigen::Vector3f::Constant(0.5f)));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Adds a mesh to another one, moved.
inline void add(ObjectMesh& mesh, const ObjectMesh& other, const Eigen::Vector3f& by) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const auto& v : other.vertices) mesh.vertices.push_back(v + by);
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// A hammer without symmetry: a handle along y, a head across, and a knob on one side [m].
inline ObjectMesh hammer_mesh() {
  ObjectMesh mesh = box_mesh({0.02f, 0.12f, 0.03f});
  mesh.name = "hammer";
  add(mesh, box_mesh({0.09f, 0.03f, 0.035f}), {0.015f, 0.06f, 0});
  add(mesh, box_mesh({0.02f, 0.02f, 0.03f}), {0, -0.04f, 0.025f});
  return mesh;
}

/// A ball around the origin [m].
inline ObjectMesh ball_mesh(float radius) {
  constexpr int kRings = 32, kSides = 48;
  ObjectMesh mesh{"ball", {}, {}};
  const auto at = [](int ring, int side) { return static_cast<std::uint32_t>(ring * kSides + side % kSides); };

  // Place the vertices on rings from pole to pole.
  for (int ring = 0; ring <= kRings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      const double polar = std::numbers::pi * ring / kRings, around = 2 * std::numbers::pi * side / kSides;
      mesh.vertices.push_back(radius * Eigen::Vector3d(std::sin(polar) * std::cos(around),
                                                       std::sin(polar) * std::sin(around), std::cos(polar))
                                           .cast<float>());
    }

  // Join neighbouring rings by triangles.
  for (int ring = 0; ring < kRings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      mesh.triangles.push_back({at(ring, side), at(ring + 1, side), at(ring + 1, side + 1)});
      mesh.triangles.push_back({at(ring, side), at(ring + 1, side + 1), at(ring, side + 1)});
    }
  return mesh;
}

}  // namespace barehand::test
