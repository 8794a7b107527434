#include "person/skin_sections.h"

#include <gtest/gtest.h>

#include <cmath>

namespace barehand {
namespace {

constexpr double kLength = 0.045;

/// A tapered tube with elliptic sections about a line from (x, y) at the joint to (0, 0) at the end. It has only the
/// part that a scan sees: the distal half of the bone, and two thirds of the circumference.
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

TEST(SkinSections, HaveTheirMiddleWhereTheBonesSkinLeadsTo) {
  const int segment = segment_of(2, 0);
  for (const double x : {-0.003, 0.0, 0.002}) {
    const auto sections = SkinSections::fit(tube(segment, x, -0.002), segment, kLength, true);
    ASSERT_TRUE(sections);
    EXPECT_NEAR(sections->middle_x(0), x, 1e-4);
    EXPECT_NEAR(sections->middle_x(1), 0, 1e-4);
  }
}

TEST(SkinSections, HaveARadiusBetweenHalfWidthAndHalfThickness) {
  const auto sections = SkinSections::fit(tube(segment_of(2, 0), 0.002, -0.002), segment_of(2, 0), kLength, true);
  ASSERT_TRUE(sections);
  EXPECT_NEAR(sections->radius(0), 0.0085, 1e-4);
  EXPECT_NEAR(sections->radius(1), 0.0065, 1e-4);
}

TEST(SkinSections, SkinOfOtherBonesSaysNothing) {
  const int segment = segment_of(2, 0);
  EXPECT_FALSE(SkinSections::fit(tube(segment_of(3, 0), 0, 0), segment, kLength, true));
  Skin skin = tube(segment, 0.001, 0);
  const double before = SkinSections::fit(skin, segment, kLength, true)->middle_x(0);
  SkinVertex web = skin.vertices[0];
  web.b = kPalm;
  web.weight_b = 0.3f;
  web.in_a.x() += 0.02f;
  skin.vertices.push_back(web);
  EXPECT_EQ(SkinSections::fit(skin, segment, kLength, true)->middle_x(0), before);
  EXPECT_GT(std::abs(SkinSections::fit(skin, segment, kLength, false)->middle_x(0) - before), 1e-4);
}

TEST(SkinSections, FollowVerticesAlongTheirNormals) {
  const int segment = segment_of(2, 0);
  Skin skin = tube(segment, 0.001, 0);
  const auto sections = SkinSections::fit(skin, segment, kLength, true);
  ASSERT_TRUE(sections);

  // Predict the effect of moving the vertices, then move them.
  double moved = sections->middle_x(0);
  for (std::size_t k = 0; k < sections->vertices().size(); ++k) {
    SkinVertex& v = skin.vertices[sections->vertices()[k]];
    const double out = 0.001 * std::sin(1.7 * static_cast<double>(k));
    v.in_a += static_cast<float>(out) * v.normal_in_a;
    moved += sections->middle_x_per_offset()[static_cast<Eigen::Index>(k)] * out;
  }

  // A new fit agrees with the prediction.
  const double after = SkinSections::fit(skin, segment, kLength, true)->middle_x(0);
  EXPECT_GT(std::abs(after - sections->middle_x(0)), 1e-5);
  EXPECT_NEAR(after, moved, 1e-7);
}

}  // namespace
}  // namespace barehand
