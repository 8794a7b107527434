#include "stages/contact/surface_distance.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

using Eigen::Vector3f;

/// Points on the plane z = 0.5 that face the camera, 3 mm apart, where `known` says so.
template <class Known>
std::vector<SurfacePoint> plane(Known known) {
  std::vector<SurfacePoint> points;
  for (int i = -15; i <= 15; ++i)
    for (int j = -15; j <= 15; ++j) {
      SurfacePoint point{{0.003f * i, 0.003f * j, 0.5f}, {0, 0, -1}};
      point.object = 7;
      if (known(point.p)) points.push_back(point);
    }
  return points;
}

/// Skin that is one point, `height` [m] in front of the plane.
PosedSkin skin_at(float height) {
  const Vector3f p(0.001f, 0.001f, 0.5f - height);
  return {{p}, {Vector3f(0, 0, 1)}, p, 0};
}

TEST(SurfaceDistance, IsThatToThePlaneWithItsSign) {
  SurfaceDistance distance;
  const auto surface = plane([](const Vector3f&) { return true; });
  for (const float height : {0.02f, 0.004f, 0.f, -0.004f}) {
    const auto nearest = distance.measure(skin_at(height), surface);
    ASSERT_TRUE(nearest) << height;
    EXPECT_NEAR(nearest->distance, height, 0.0005) << height;
    EXPECT_NEAR(nearest->point.z(), 0.5, 0.0005);
    EXPECT_LT(nearest->normal.z(), -0.99);
    EXPECT_EQ(nearest->object, 7);
  }
}

TEST(SurfaceDistance, LiesBetweenThePlaneAndTheLastPointSeenWhereSkinCoversTheSurface) {
  SurfaceDistance distance;
  const auto around = plane([](const Vector3f& p) { return p.head<2>().norm() > 0.01f; });
  const auto nearest = distance.measure(skin_at(0.002f), around);
  ASSERT_TRUE(nearest);
  EXPECT_GT(nearest->distance, 0.002);
  EXPECT_LT(nearest->distance, 0.01);
  const auto seen = distance.measure(skin_at(0.002f), plane([](const Vector3f&) { return true; }));
  EXPECT_GT(nearest->deviation, seen->deviation + 0.001);
}

TEST(SurfaceDistance, IsNotKnownFarAwayOrBehind) {
  SurfaceDistance distance;
  const auto surface = plane([](const Vector3f&) { return true; });
  EXPECT_FALSE(distance.measure(skin_at(0.05f), surface));
  EXPECT_FALSE(distance.measure(skin_at(-0.02f), surface)) << "behind what is seen, where its far side may be";
  EXPECT_FALSE(distance.measure(skin_at(0), {}));
}

}  // namespace
}  // namespace barehand
