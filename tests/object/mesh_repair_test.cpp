#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "math/mesh_distance.h"
#include "support/solid_meshes.h"

namespace barehand {
namespace {

using testing::HasSubstr;

/// A triangle soup of the same surface, as STL files hold it.
ObjectMesh soup(const ObjectMesh& mesh) {
  ObjectMesh out{mesh.name, {}, {}};
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    for (const auto v : t) out.vertices.push_back(mesh.vertices[v]);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

bool inside(const ObjectMesh& mesh, const Eigen::Vector3d& p) {
  return MeshDistance(mesh.vertices, mesh.triangles).inside(p);
}

std::string refusal(ObjectMesh mesh) {
  const auto repaired = repair_mesh(mesh, "thing.obj");
  return repaired ? "repaired" : repaired.error().message();
}

TEST(MeshRepair, AClosedMeshStaysAsItIs) {
  ObjectMesh mesh = test::hammer_mesh();
  const auto before = mesh.triangles;
  const auto repair = repair_mesh(mesh, "");
  ASSERT_TRUE(repair);
  EXPECT_EQ(repair->merged + repair->removed + repair->flipped + repair->closed, 0u);
  EXPECT_EQ(mesh.triangles, before);
}

TEST(MeshRepair, MergesTheVerticesOfASoup) {
  ObjectMesh mesh = soup(test::box_mesh({0.1f, 0.1f, 0.1f}));
  const auto repair = repair_mesh(mesh, "");
  ASSERT_TRUE(repair);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(repair->closed, 0u);
}

TEST(MeshRepair, TurnsTrianglesOutwards) {
  ObjectMesh inwards = test::box_mesh({0.1f, 0.1f, 0.1f}), mixed = inwards;
  for (auto& t : inwards.triangles) std::swap(t[1], t[2]);
  for (std::size_t i = 0; i < mixed.triangles.size(); i += 3) std::swap(mixed.triangles[i][1], mixed.triangles[i][2]);
  for (ObjectMesh* mesh : {&inwards, &mixed}) {
    const auto repair = repair_mesh(*mesh, "");
    ASSERT_TRUE(repair);
    EXPECT_GT(repair->flipped, 0u);
    EXPECT_TRUE(inside(*mesh, {0.01, 0.02, 0.03}));
    EXPECT_FALSE(inside(*mesh, {0.06, 0, 0}));
  }
}

TEST(MeshRepair, ClosesASmallHole) {
  ObjectMesh mesh = test::ball_mesh(0.05f);
  ASSERT_TRUE(repair_mesh(mesh, ""));
  mesh.triangles.erase(mesh.triangles.begin() + 300, mesh.triangles.begin() + 302);
  const auto repair = repair_mesh(mesh, "");
  ASSERT_TRUE(repair) << repair.error().message();
  EXPECT_EQ(repair->closed, 1u);
  EXPECT_TRUE(inside(mesh, {0, 0, 0}));
}

TEST(MeshRepair, RemovesWhatIsGivenTwice) {
  ObjectMesh mesh = test::box_mesh({0.1f, 0.1f, 0.1f});
  mesh.triangles.push_back(mesh.triangles.front());
  mesh.triangles.push_back({0, 0, 1});
  const auto repair = repair_mesh(mesh, "");
  ASSERT_TRUE(repair);
  EXPECT_EQ(repair->removed, 2u);
}

TEST(MeshRepair, RefusesWhatCannotBeASolid) {
  // A box without a side, a sheet, an extra fin, and a Moebius strip.
  ObjectMesh open = test::box_mesh({0.1f, 0.1f, 0.1f});
  open.triangles.resize(10);
  EXPECT_THAT(refusal(open), HasSubstr("an opening 141.4 mm wide"));

  ObjectMesh sheet{"sheet", {{0, 0, 0}, {0.1f, 0, 0}, {0, 0.1f, 0}, {0.1f, 0.1f, 0}}, {{0, 1, 2}, {1, 3, 2}}};
  EXPECT_THAT(refusal(sheet), HasSubstr("not closed"));

  ObjectMesh fin = test::box_mesh({0.1f, 0.1f, 0.1f});
  fin.vertices.emplace_back(0.2f, 0, 0);
  fin.triangles.push_back({0, 1, 8});
  EXPECT_THAT(refusal(fin), HasSubstr("3 triangles meet at one edge"));

  ObjectMesh strip{"strip", {}, {}};
  constexpr std::uint32_t kParts = 12;
  for (std::uint32_t i = 0; i < kParts; ++i) {
    const double around = 2 * std::numbers::pi * i / kParts, turn = around / 2;
    for (const double side : {-0.02, 0.02}) {
      const double r = 0.05 + side * std::cos(turn);
      strip.vertices.push_back(
          Eigen::Vector3d(r * std::cos(around), r * std::sin(around), side * std::sin(turn)).cast<float>());
    }
  }
  for (std::uint32_t i = 0; i < kParts; ++i) {
    const std::uint32_t a = 2 * i, b = a + 1;
    const std::uint32_t c = i + 1 < kParts ? a + 2 : 1, d = i + 1 < kParts ? a + 3 : 0;
    strip.triangles.push_back({a, b, c});
    strip.triangles.push_back({b, d, c});
  }
  EXPECT_THAT(refusal(strip), HasSubstr("one side only"));

  EXPECT_THAT(refusal({"nothing", {}, {}}), HasSubstr("holds no triangles"));
}

}  // namespace
}  // namespace barehand
