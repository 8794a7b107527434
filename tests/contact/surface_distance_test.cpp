#include "stages/contact/surface_distance.h"

#include <gtest/gtest.h>

#include <cmath>

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

bool unknown(std::int32_t, const Vector3f&) { return false; }

TEST(SurfaceDistance, IsThatToThePlaneWithItsSign) {
  SurfaceDistance distance;
  const auto surface = plane([](const Vector3f&) { return true; });
  for (const float height : {0.02f, 0.004f, 0.f}) {
    const auto nearest = distance.measure(skin_at(height), surface, unknown);
    ASSERT_TRUE(nearest) << height;
    EXPECT_NEAR(nearest->distance, height, 0.0005) << height;
    EXPECT_NEAR(nearest->point.z(), 0.5, 0.0005);
    EXPECT_LT(nearest->normal.z(), -0.99);
    EXPECT_EQ(nearest->object, 7);
  }
}

TEST(SurfaceDistance, SkinThatSeemsToBeInsideTouches) {
  SurfaceDistance distance;
  const auto nearest = distance.measure(skin_at(-0.004f), plane([](const Vector3f&) { return true; }), unknown);
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->distance, -0.001, 1e-6);
  EXPECT_NEAR(nearest->deviation, 0.003, 0.0005) << "it may be behind something thin";
}

TEST(SurfaceDistance, LiesBetweenThePlaneAndTheLastPointSeenWhereSkinCoversTheSurface) {
  SurfaceDistance distance;
  const auto around = plane([](const Vector3f& p) { return p.head<2>().norm() > 0.01f; });
  const auto nearest = distance.measure(skin_at(0.002f), around, unknown);
  ASSERT_TRUE(nearest);
  EXPECT_GT(nearest->distance, 0.002);
  EXPECT_LT(nearest->distance, 0.01);
  const auto seen = distance.measure(skin_at(0.002f), plane([](const Vector3f&) { return true; }), unknown);
  EXPECT_GT(nearest->deviation, seen->deviation + 0.001);
}

TEST(SurfaceDistance, ASurfaceEndsWhereItsPlaneIsSeenToBeEmpty) {
  SurfaceDistance distance;
  const auto half = plane([](const Vector3f& p) { return p.x() < -0.014f; });
  const auto beyond = [](std::int32_t object, const Vector3f& p) { return object == 7 && p.x() > -0.012f; };
  const auto covered = distance.measure(skin_at(0), half, unknown), beside = distance.measure(skin_at(0), half, beyond);
  ASSERT_TRUE(covered && beside);
  EXPECT_LT(covered->distance, 0.004) << "the surface may go on below the skin";
  EXPECT_GT(beside->distance, 0.01);
  EXPECT_LT(beside->point.x(), -0.01);
}

TEST(SurfaceDistance, ASurfaceBendsOnAsItIsSeenToBend) {
  // A cylinder about the y axis, seen from the camera's side, but for a strip.
  constexpr float kRadius = 0.02f;
  const auto cylinder = [&](float from, float to) {
    std::vector<SurfacePoint> points;
    for (float angle = from; angle < to; angle += 0.1f)
      for (int j = -5; j <= 5; ++j) {
        const Vector3f n(std::sin(angle), 0, -std::cos(angle));
        points.push_back({Vector3f(0, 0.003f * j, 0.5f) + kRadius * n, n, 0, 7});
      }
    return points;
  };
  const auto flat = plane([](const Vector3f& p) { return p.x() < -0.011f; });
  PosedSkin skin = skin_at(0);
  SurfaceDistance distance;
  const float on_flat = distance.measure(skin, flat, unknown)->distance;

  // Skin in the tangent plane, as far beside the last point that is seen.
  skin.points[0] = skin.centre = Vector3f(0.012f, 0.001f, 0.5f - kRadius);
  const float on_round = distance.measure(skin, cylinder(-1, 0.05f), unknown)->distance;
  const float truth = std::hypot(0.012f, kRadius) - kRadius;
  EXPECT_NEAR(on_round, truth, 0.0015);
  EXPECT_GT(on_round, on_flat + 0.001);
}

TEST(SurfaceDistance, IsNotKnownFarAwayOrBehind) {
  SurfaceDistance distance;
  const auto surface = plane([](const Vector3f&) { return true; });
  EXPECT_FALSE(distance.measure(skin_at(0.05f), surface, unknown));
  EXPECT_FALSE(distance.measure(skin_at(-0.02f), surface, unknown)) << "behind what is seen, where its far side may be";
  EXPECT_FALSE(distance.measure(skin_at(0), {}, unknown));
}

}  // namespace
}  // namespace barehand
