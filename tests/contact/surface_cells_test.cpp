#include "stages/contact/surface_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hand/skin.h"
#include "support/painted_hand.h"

namespace barehand {
namespace {

/// A hand at this distance [m], the estimate of its pose, and what an ideal camera sees of it.
struct Scene {
  explicit Scene(double distance) {
    const auto profile = test::adult_hand();
    const Skin skin = make_blended_skin(*profile, 0.005);
    const HandPose pose = test::facing_pose(*profile, distance);
    for (int s = 0; s < kSegmentCount; ++s) estimate->segments[s].T_camera_segment = pose[s];
    observation = test::observe_skin(skin, pose, 2.0);
  }
  /// The points of the surfaces, of which there must be one.
  std::vector<SurfacePoint> points() const {
    SurfaceCells cells;
    std::vector<SurfacePoint> points;
    std::vector<bool> open;
    cells.collect(
        {observation}, {estimate}, 0, [](const Eigen::Vector3f&) { return true; }, points, open);
    EXPECT_EQ(open.size(), 1u);
    return points;
  }
  std::shared_ptr<HandEstimate> estimate = std::make_shared<HandEstimate>();
  std::shared_ptr<HandObservation> observation;
};

// Cells are three pixels wide here. A pencil of four pixels shares two cells, wherever it lies.
TEST(SurfaceCells, AThinThingIsSeenWhereverItLies) {
  for (int left = 0; left < 3; ++left) {
    const Scene scene(0.31);
    const int u0 = 285 + left, v0 = 90;
    for (int v = v0; v < v0 + 50; ++v)
      for (int u = u0; u < u0 + 4; ++u) {
        ASSERT_EQ(scene.observation->label.at(u, v), PixelLabel::background);
        scene.observation->label.at(u, v) = PixelLabel::object;
        scene.observation->depth.at(u, v) = 0.31f;
      }
    const auto on_pencil = [](const SurfacePoint& p) { return std::abs(p.p.z() - 0.31f) < 1e-4f; };
    EXPECT_GE(std::ranges::count_if(scene.points(), on_pencil), 14) << left;
  }
}

TEST(SurfaceCells, PointsLieOnABallInItsMiddleAndAtItsRim) {
  constexpr float kRadius = 0.03f;
  const Scene scene(0.31);
  HandObservation& seen = *scene.observation;
  seen.depth.at(275, 120) = 0.31f;
  const Eigen::Vector3f centre = seen.point(275, 120);
  for (int v = 0; v < seen.depth.height(); ++v)
    for (int u = 0; u < seen.depth.width(); ++u) {
      // Intersect the line of sight with the ball.
      const Eigen::Vector3f ray = seen.point(u, v) / seen.depth.at(u, v);
      const float half = ray.dot(centre),
                  inside = half * half - ray.squaredNorm() * (centre.squaredNorm() - kRadius * kRadius);
      if (inside <= 0) continue;
      ASSERT_EQ(seen.label.at(u, v), PixelLabel::background) << u << " " << v;
      seen.label.at(u, v) = PixelLabel::object;
      seen.depth.at(u, v) = (half - std::sqrt(inside)) / ray.squaredNorm();
    }

  const auto points = scene.points();
  ASSERT_GT(points.size(), 100u);
  for (const SurfacePoint& point : points) {
    // Beyond 52 degrees from the line of sight, a pixel sees too long a piece of the ball.
    const Eigen::Vector3f out = point.p - centre;
    const float slant = std::acos(std::min(1.0f, -out.normalized().z()));
    if (slant > 0.9f) continue;
    EXPECT_NEAR(out.norm(), kRadius, 5e-4f) << slant;
  }
}

}  // namespace
}  // namespace barehand
