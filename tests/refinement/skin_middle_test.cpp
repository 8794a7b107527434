#include "stages/refinement/skin_middle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace barehand {
namespace {

constexpr double kLength = 0.045;

/// A tapered tube of elliptic sections about a line from (x, y) at the joint to (0, 0) at the end, as far as it shows:
/// from the middle of the bone on, and on two thirds of its girth.
Skin tube(int segment, double x, double y) {
  Skin skin;
  for (double u = 0.4; u < 1; u += 0.1)
    for (double angle = -0.9; angle < 2.4; angle += 0.15) {
      const double wide = 0.009 - 0.002 * u, thick = wide - 0.001;
      const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0);
      SkinVertex v{};
      v.a = v.b = static_cast<std::int16_t>(segment);
      v.in_a = Eigen::Vector3d(x * (1 - u) + wide * out.x(), y * (1 - u) + thick * out.y(), -kLength * u).cast<float>();
      v.normal_in_a = Eigen::Vector3d(out.x() / wide, out.y() / thick, 0).normalized().cast<float>();
      skin.vertices.push_back(v);
    }
  return skin;
}

TEST(SkinMiddle, IsWhereTheBonesSkinLeadsTo) {
  const int segment = segment_of(2, 0);
  for (const double x : {-0.003, 0.0, 0.002}) {
    const auto middle = skin_middle(tube(segment, x, -0.002), segment, kLength);
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->x, x, 1e-4);
  }
}

TEST(SkinMiddle, SkinOfOtherBonesSaysNothing) {
  const int segment = segment_of(2, 0);
  EXPECT_FALSE(skin_middle(tube(segment_of(3, 0), 0, 0), segment, kLength));
  Skin skin = tube(segment, 0.001, 0);
  const double before = skin_middle(skin, segment, kLength)->x;
  SkinVertex web = skin.vertices[0];
  web.b = kPalm;
  web.weight_b = 0.3f;
  web.in_a.x() += 0.02f;
  skin.vertices.push_back(web);
  EXPECT_EQ(skin_middle(skin, segment, kLength)->x, before);
}

TEST(SkinMiddle, FollowsVerticesAlongTheirNormals) {
  const int segment = segment_of(2, 0);
  Skin skin = tube(segment, 0.001, 0);
  const auto middle = skin_middle(skin, segment, kLength);
  ASSERT_TRUE(middle);
  double moved = middle->x;
  for (const auto& [vertex, change] : middle->per_offset) {
    const double out = 0.001 * std::sin(1.7 * vertex);
    skin.vertices[vertex].in_a += static_cast<float>(out) * skin.vertices[vertex].normal_in_a;
    moved += change * out;
  }
  const double after = skin_middle(skin, segment, kLength)->x;
  EXPECT_GT(std::abs(after - middle->x), 1e-5);
  EXPECT_NEAR(after, moved, 1e-7);
}

}  // namespace
}  // namespace barehand
