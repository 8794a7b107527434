#include "stages/contact/scanned_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace barehand {
namespace {

using Eigen::Vector3f;

constexpr float kRadius = 0.03f;

/// Samples of a sphere, as far as they are above a height.
std::vector<SurfaceSample> sphere(float lowest) {
  constexpr int kCount = 800;
  std::vector<SurfaceSample> samples;
  for (int i = 0; i < kCount; ++i) {
    const float z = 1 - 2 * (i + 0.5f) / kCount,
                turn = static_cast<float>(i) * std::numbers::phi_v<float> * 2 * std::numbers::pi_v<float>;
    const Vector3f n(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
    if (kRadius * z > lowest) samples.push_back({kRadius * n, n});
  }
  return samples;
}

/// How many holes repair_mesh() finds; -1: it cannot repair the mesh.
int holes(ObjectMesh mesh) {
  const auto repair = repair_mesh(mesh, "scan");
  return repair ? static_cast<int>(repair->closed) : -1;
}

TEST(ScannedMesh, IsTheSurfaceThatWasSeen) {
  const ScannedMesh scanned = scanned_mesh(sphere(-1), 0.003);
  ASSERT_GT(scanned.mesh.triangles.size(), 1000u);
  EXPECT_EQ(holes(scanned.mesh), 0);
  EXPECT_GT(scanned.seen, 0.99);
  for (const Vector3f& v : scanned.mesh.vertices) ASSERT_NEAR(v.norm(), kRadius, 0.0006);
}

TEST(ScannedMesh, ClosesWhatWasNotSeenWithAFlatLid) {
  const ScannedMesh scanned = scanned_mesh(sphere(0), 0.003);
  ASSERT_GT(scanned.mesh.triangles.size(), 500u);
  EXPECT_EQ(holes(scanned.mesh), 0);
  EXPECT_NEAR(scanned.seen, 0.67, 0.1) << "a hemisphere has twice the area of its lid";
  float lowest = 0;
  for (std::size_t i = scanned.lids; i < scanned.mesh.triangles.size(); ++i)
    for (const auto v : scanned.mesh.triangles[i]) lowest = std::min(lowest, scanned.mesh.vertices[v].z());
  EXPECT_GT(lowest, -0.006f);
}

TEST(ScannedMesh, KeepsASheetOfTwoSidesApart) {
  std::vector<SurfaceSample> samples;
  for (int i = -8; i <= 8; ++i)
    for (int j = -8; j <= 8; ++j)
      for (const float side : {-1.0f, 1.0f}) samples.push_back({{0.003f * i, 0.003f * j, 0.003f * side}, {0, 0, side}});
  const ScannedMesh scanned = scanned_mesh(samples, 0.002);
  ASSERT_FALSE(scanned.mesh.triangles.empty());
  EXPECT_EQ(holes(scanned.mesh), 0);
  for (const Vector3f& v : scanned.mesh.vertices)
    if (std::abs(v.x()) < 0.02f && std::abs(v.y()) < 0.02f) {
      ASSERT_NEAR(std::abs(v.z()), 0.003f, 0.0005f);
    }
}

TEST(ScannedMesh, LeavesOutSpecksAndWhatIsTooSmall) {
  std::vector<SurfaceSample> samples = sphere(-1);
  const std::size_t vertices = scanned_mesh(samples, 0.004).mesh.vertices.size();
  for (int i = 0; i < 8; ++i) samples.push_back({{0.06f, 0.003f * i, 0}, {1, 0, 0}});
  const auto mesh = scanned_mesh(samples, 0.004).mesh;
  EXPECT_NEAR(static_cast<double>(mesh.vertices.size()), static_cast<double>(vertices),
              0.1 * static_cast<double>(vertices));
  for (const Vector3f& v : mesh.vertices) ASSERT_LT(v.x(), 0.04f);
  EXPECT_TRUE(scanned_mesh(std::span(samples).first(50), 0.004).mesh.triangles.empty());
}

}  // namespace
}  // namespace barehand
