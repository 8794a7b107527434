#include "hand/surface_nets.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

namespace barehand {
namespace {

using Eigen::Vector3d;

double signed_volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& t : mesh.triangles)
    volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  return volume;
}

TEST(ExtractSurface, SphereHasItsVolumeAndOutwardTriangles) {
  const Vector3d centre(0.01, -0.02, 0.003);
  const double radius = 0.03;
  const auto distance = [&](const Vector3d& p) { return (p - centre).norm() - radius; };
  const TriangleMesh mesh = extract_surface(distance, Vector3d::Constant(-0.06), Vector3d::Constant(0.06), 0.004);
  for (const Vector3d& v : mesh.vertices) EXPECT_NEAR(distance(v), 0, 1e-5);
  const double volume = 4.0 / 3 * std::numbers::pi * radius * radius * radius;
  // Chords lie inside; a surface turned inside out would have a negative volume.
  EXPECT_NEAR(signed_volume(mesh), volume, 0.02 * volume);
}

TEST(ExtractSurface, IsClosed) {
  const auto distance = [](const Vector3d& p) { return p.cwiseAbs().maxCoeff() - 0.02; };
  const TriangleMesh mesh = extract_surface(distance, Vector3d::Constant(-0.033), Vector3d::Constant(0.033), 0.005);
  Vector3d area = Vector3d::Zero();  // the area vectors of a closed surface add up to zero
  double total = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    const Vector3d directed = 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    area += directed;
    total += directed.norm();
  }
  ASSERT_GT(total, 0);
  EXPECT_LT(area.norm(), 1e-9 * total);
}

}  // namespace
}  // namespace barehand
