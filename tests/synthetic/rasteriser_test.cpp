#include "drivers/synthetic/rendering/rasteriser.h"

#include <gtest/gtest.h>

#include "drivers/synthetic/rendering/scene_geometry.h"
#include "drivers/synthetic/rendering/shapes.h"
#include "math/random.h"

namespace barehand::synthetic {
namespace {

const Intrinsics kCamera = {160, 120, 131.25, 131.25, 79.5, 59.5};

SceneGeometry ball_at(const Eigen::Vector3d& centre, double radius) {
  SceneGeometry scene;
  scene.add(make_sphere(radius), SE3{Eigen::Matrix3d::Identity(), centre}, 0);
  return scene;
}

/// Depth (z) of the first intersection of a pixel's ray with a ball [m]; 0 if it misses the ball.
double analytic_depth(int u, int v, const Eigen::Vector3d& centre, double radius) {
  const Eigen::Vector3d ray = kCamera.unproject(u, v, 1);
  const double a = ray.squaredNorm(), b = ray.dot(centre), c = centre.squaredNorm() - radius * radius;
  const double discriminant = b * b - a * c;
  return discriminant < 0 ? 0 : (b - std::sqrt(discriminant)) / a;
}

TEST(Rasteriser, DepthOfABallIsAnalytic) {
  // Render a ball.
  const Eigen::Vector3d centre(0.05, -0.03, 0.5);
  const double radius = 0.08;
  const SceneGeometry scene = ball_at(centre, radius);
  Rasteriser rasteriser(kCamera);
  rasteriser.draw(scene.vertices, scene.triangles, 0);

  // Compare with the exact intersection.
  int hits = 0, disagreeing = 0;
  for (int v = 0; v < kCamera.height; ++v)
    for (int u = 0; u < kCamera.width; ++u) {
      const double expected = analytic_depth(u, v, centre, radius);
      const float inverse = rasteriser.buffer().inverse_z.at(u, v);
      if ((expected > 0) != (inverse > 0)) {
        ++disagreeing;
        continue;
      }
      if (expected == 0) continue;
      ++hits;
      // The points are on the ball, up to the distance (sagitta) of its flat facets from the sphere. Where the ball
      // faces the camera, the depth is accurate, too.
      EXPECT_NEAR((kCamera.unproject(u, v, 1 / inverse) - centre).norm(), radius, 9e-5) << u << " " << v;
      if (expected < centre.z() - 0.85 * radius) {
        EXPECT_NEAR(1 / inverse, expected, 1.2e-4) << u << " " << v;
      }
    }
  EXPECT_GT(hits, 1200);
  EXPECT_LT(disagreeing, 0.02 * hits);
}

TEST(Rasteriser, DepthOfATiltedPlaneIsExact) {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.5, -0.4, -1).normalized();
  const Eigen::Vector3d origin(0, 0, 0.6), a = normal.unitOrthogonal(), b = normal.cross(a);
  SceneGeometry scene;
  scene.add(make_plate(origin - 0.1 * a - 0.1 * b, 0.2 * a, 0.2 * b), SE3{}, 0);
  Rasteriser rasteriser(kCamera);
  rasteriser.draw(scene.vertices, scene.triangles, 0);
  for (int v = 0; v < kCamera.height; ++v)
    for (int u = 0; u < kCamera.width; ++u) {
      const float inverse = rasteriser.buffer().inverse_z.at(u, v);
      if (inverse == 0) continue;
      EXPECT_NEAR(1 / inverse, normal.dot(origin) / normal.dot(kCamera.unproject(u, v, 1)), 2e-6);
    }
}

TEST(Rasteriser, TrianglesThatShareEdgesLeaveNoGapAndNoOverlap) {
  // A grid of vertices with random positions.
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  KeyedRandom random(3, 1);
  constexpr int n = 9;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const bool inner = i > 0 && j > 0 && i + 1 < n && j + 1 < n;
      const double s = inner ? 0.01 : 0;
      vertices.emplace_back(static_cast<float>(-0.2 + 0.05 * i + random.uniform(-s, s)),
                            static_cast<float>(-0.2 + 0.05 * j + random.uniform(-s, s)), 0.5f);
    }

  // Two triangles per cell.
  for (std::uint32_t j = 0; j + 1 < n; ++j)
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      triangles.push_back({j * n + i, (j + 1) * n + i + 1, j * n + i + 1});
      triangles.push_back({j * n + i, (j + 1) * n + i, (j + 1) * n + i + 1});
    }

  // Each pixel is covered exactly once.
  Image<int> count(kCamera.width, kCamera.height, 0);
  for (const Triangle& t : triangles) {
    Rasteriser single(kCamera);
    single.draw(vertices, std::vector{t}, 0);
    for (std::size_t i = 0; i < count.size(); ++i) count[i] += single.buffer().triangle[i] != kNoTriangle;
  }
  for (int v = 8; v < kCamera.height - 8; ++v)
    for (int u = 30; u < kCamera.width - 30; ++u) EXPECT_EQ(count.at(u, v), 1) << u << " " << v;
}

TEST(Rasteriser, NearerSurfaceWinsWhateverTheOrder) {
  const SceneGeometry near = ball_at({0, 0, 0.4}, 0.03), far = ball_at({0, 0, 0.6}, 0.1);
  for (const bool near_first : {true, false}) {
    Rasteriser rasteriser(kCamera);
    const auto draw_near = [&] { rasteriser.draw(near.vertices, near.triangles, 0); };
    const auto draw_far = [&] { rasteriser.draw(far.vertices, far.triangles, 100000); };
    near_first ? (draw_near(), draw_far()) : (draw_far(), draw_near());
    EXPECT_LT(rasteriser.buffer().triangle.at(80, 60), 100000u);
    EXPECT_NEAR(1 / rasteriser.buffer().inverse_z.at(80, 60), 0.37, 0.001);
  }
}

TEST(Rasteriser, ClipsWhatReachesBehindTheCamera) {
  SceneGeometry scene;  // a floor below the camera, from far behind to far in front of it
  scene.add(make_plate({-5, 0.3, -5}, {0, 0, 10}, {10, 0, 0}), SE3{}, 0);
  Rasteriser rasteriser(kCamera);
  rasteriser.draw(scene.vertices, scene.triangles, 0);
  EXPECT_EQ(rasteriser.buffer().inverse_z.at(80, 30), 0) << "above the horizon";
  EXPECT_NEAR(1 / rasteriser.buffer().inverse_z.at(80, 110), 0.3 / ((110 - kCamera.cy) / kCamera.fy), 1e-4);
}

TEST(CoveredPixels, CountEachClassAloneAndOutsideTheView) {
  const TriangleMesh ball = make_sphere(0.05);
  SceneGeometry scene;
  scene.add(ball, SE3{Eigen::Matrix3d::Identity(), {0, 0, 0.5}}, 0);
  scene.add(ball, SE3{Eigen::Matrix3d::Identity(), {0, 0, 0.5}}, 1);     // at the same place: hidden by the first ball
  scene.add(ball, SE3{Eigen::Matrix3d::Identity(), {0.35, 0, 0.5}}, 2);  // outside the image but within the margin
  const auto covered = covered_pixels(kCamera, 60, scene.vertices, scene.triangles, scene.surface);
  EXPECT_EQ(covered[0], covered[1]);
  EXPECT_NEAR(covered[0], 550, 20);
  EXPECT_GT(covered[2], 500);
  EXPECT_EQ(covered[3], 0);
}

}  // namespace
}  // namespace barehand::synthetic
