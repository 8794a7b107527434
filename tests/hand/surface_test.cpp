#include "hand/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace barehand {
namespace {

constexpr double kPi = std::numbers::pi;
const int kTip = segment_of(1, 2), kMiddle = segment_of(1, 1);

HandProfile simple_profile() {
  HandProfile profile;
  for (SegmentProfile& s : profile.segments) {
    s.distal = {0, 0, -0.04};
    s.length = 0.04;
    s.radius = {0.010, 0.007};
    s.half_width = {0.04, 0.04};
    s.half_thickness = {0.015, 0.015};
  }
  return profile;
}

double total_area(const SegmentSurface& skin) { return std::accumulate(skin.area.begin(), skin.area.end(), 0.0); }
Eigen::Vector3d point(const SegmentSurface& s, std::size_t i) { return {s.x[i], s.y[i], s.z[i]}; }
Eigen::Vector3d normal(const SegmentSurface& s, std::size_t i) { return {s.nx[i], s.ny[i], s.nz[i]}; }
double frustum_area(double r0, double r1, double length) { return kPi * (r0 + r1) * std::hypot(length, r0 - r1); }

TEST(CylinderSurface, HasTheNumberOfPointsAskedFor) {
  const HandSurface surface = make_cylinder_surface(simple_profile(), 77);
  for (const SegmentSurface& skin : surface) EXPECT_EQ(skin.size(), 77u);
}

TEST(CylinderSurface, AreaOfATaperedCylinderIsThatOfAFrustum) {
  const HandSurface surface = make_cylinder_surface(simple_profile(), 100);
  const double expected = frustum_area(0.010, 0.007, 0.04);
  EXPECT_NEAR(total_area(surface[kMiddle]), expected, 1e-5 * expected);
}

TEST(CylinderSurface, TipAddsAHemisphere) {
  const HandSurface surface = make_cylinder_surface(simple_profile(), 100);
  const double expected = frustum_area(0.010, 0.007, 0.04) + 2 * kPi * 0.007 * 0.007;
  EXPECT_NEAR(total_area(surface[kTip]), expected, 1e-5 * expected);
}

TEST(CylinderSurface, PalmSlabHasTheAreaOfAnEllipticCylinder) {
  const HandSurface surface = make_cylinder_surface(simple_profile(), 200);
  // Perimeter of an ellipse: 4 a E(k) with the complete elliptic integral of the second kind.
  const double perimeter = 4 * 0.04 * std::comp_ellint_2(std::sqrt(1 - 0.015 * 0.015 / (0.04 * 0.04)));
  EXPECT_NEAR(total_area(surface[kPalm]), perimeter * 0.04, 1e-4 * perimeter * 0.04);
}

TEST(CylinderSurface, PointsLieOnTheSkinWithOutwardUnitNormals) {
  const HandSurface surface = make_cylinder_surface(simple_profile(), 120);
  const SegmentSurface& skin = surface[kTip];
  for (std::size_t i = 0; i < skin.size(); ++i) {
    const Eigen::Vector3d p = point(skin, i), n = normal(skin, i);
    ASSERT_NEAR(n.norm(), 1, 1e-5);

    if (p.z() > -0.04) {  // frustum: the normal leans forward by the slope of the taper
      const double t = -p.z() / 0.04;
      EXPECT_NEAR(std::hypot(p.x(), p.y()), 0.010 - 0.003 * t, 1e-6);
      const Eigen::Vector3d radial = Eigen::Vector3d(p.x(), p.y(), 0).normalized();
      EXPECT_NEAR(n.dot(radial), 0.04 / std::hypot(0.04, 0.003), 1e-4);
      EXPECT_LT(n.z(), 0);
    } else {  // cap: sphere around the tip
      const Eigen::Vector3d r = p - Eigen::Vector3d(0, 0, -0.04);
      EXPECT_NEAR(r.norm(), 0.007, 1e-6);
      EXPECT_NEAR(n.dot(r.normalized()), 1, 1e-5);
    }
  }
}

TEST(CylinderSurface, PointsAreEvenlySpread) {
  // With an even distribution, the nearest neighbour of every point is about sqrt(area per point) away, unlike in
  // clumps and gaps.
  const SegmentSurface skin = make_cylinder_surface(simple_profile(), 150)[kMiddle];
  const double spacing = std::sqrt(skin.area[0]);
  for (std::size_t i = 0; i < skin.size(); ++i) {
    double nearest = 1;
    for (std::size_t j = 0; j < skin.size(); ++j)
      if (j != i) nearest = std::min(nearest, (point(skin, i) - point(skin, j)).norm());
    EXPECT_GT(nearest, 0.45 * spacing) << "point " << i;
    EXPECT_LT(nearest, 1.5 * spacing) << "point " << i;
  }
}

TEST(CylinderSurface, FollowsABoneThatIsNotAlongTheAxis) {
  HandProfile profile = simple_profile();
  const Eigen::Vector3d distal(0.005, -0.004, -0.039);
  profile.segments[kMiddle].distal = distal;
  profile.segments[kMiddle].radius = {0.008, 0.008};
  const SegmentSurface skin = make_cylinder_surface(profile, 50)[kMiddle];
  for (std::size_t i = 0; i < skin.size(); ++i) {
    EXPECT_NEAR(point(skin, i).cross(distal.normalized()).norm(), 0.008, 1e-6);
    EXPECT_NEAR(normal(skin, i).dot(distal), 0, 1e-7);
  }
}

}  // namespace
}  // namespace barehand
