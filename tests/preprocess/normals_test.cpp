#include "stages/preprocess/normals.h"

#include <gtest/gtest.h>

#include <random>

namespace barehand {
namespace {

/// A sphere of 60 mm radius half a metre away; noise in metres.
struct Sphere {
  HandObservation observation;
  Image<std::uint8_t> mask;
  Eigen::Vector3f centre{0.03f, -0.02f, 0.5f};
  float radius = 0.06f;

  explicit Sphere(double noise) {
    auto frame = std::make_shared<RgbdFrame>();
    frame->camera = {640, 480, 525, 525, 319.5, 239.5};
    observation.u0 = 240;
    observation.v0 = 120;
    observation.depth.reset(220, 220);
    mask.reset(220, 220);
    std::mt19937 random(3);
    std::normal_distribution<float> gauss(0, static_cast<float>(std::max(noise, 1e-12)));
    for (int v = 0; v < 220; ++v)
      for (int u = 0; u < 220; ++u) {
        const Eigen::Vector3f ray = frame->camera.unproject(u + 240, v + 120, 1).cast<float>();
        const float a = ray.squaredNorm(), b = ray.dot(centre);
        const float root = b * b - a * (centre.squaredNorm() - radius * radius);
        if (root <= 0) continue;
        observation.depth.at(u, v) = (b - std::sqrt(root)) / a + gauss(random);
        mask.at(u, v) = 1;
        observation.hand_pixels.push_back(static_cast<std::int32_t>(mask.index(u, v)));
      }
    observation.frame = frame;
  }
  /// Mean angle [deg] between fitted and true normals where the surface faces the camera within 60 degrees.
  double mean_error_deg() const {
    double sum = 0;
    int count = 0;
    for (const std::int32_t i : observation.hand_pixels) {
      const Eigen::Vector3f truth = (observation.point(i) - centre).normalized();
      if (truth.z() > -0.5f) continue;
      sum += std::acos(std::clamp(truth.dot(observation.normal[i]), -1.f, 1.f)) * 180 / M_PI;
      ++count;
    }
    return sum / count;
  }
};

TEST(NormalFitter, MatchASphere) {
  Sphere sphere(0);
  NormalFitter().fit(sphere.mask, 0.004, sphere.observation);
  EXPECT_LT(sphere.mean_error_deg(), 0.5);
}

TEST(NormalFitter, SmoothKinectClassNoise) {
  Sphere sphere(0.0012);
  NormalFitter().fit(sphere.mask, 0.004, sphere.observation);
  EXPECT_LT(sphere.mean_error_deg(), 10);
}

TEST(NormalFitter, PointTowardsTheCamera) {
  Sphere sphere(0.0012);
  NormalFitter().fit(sphere.mask, 0.004, sphere.observation);
  for (const std::int32_t i : sphere.observation.hand_pixels) {
    const Eigen::Vector3f n = sphere.observation.normal[i];
    if (n.isZero()) continue;
    ASSERT_NEAR(n.norm(), 1.f, 1e-4f);
    ASSERT_LT(n.dot(sphere.observation.point(i)), 0);
  }
}

TEST(NormalFitter, IgnoreWhatLiesBeyondADepthEdge) {
  Sphere sphere(0);
  sphere.observation.hand_pixels.clear();
  for (std::size_t i = 0; i < sphere.mask.size(); ++i) {
    sphere.observation.hand_pixels.push_back(static_cast<std::int32_t>(i));
    const int u = static_cast<int>(i) % 220;
    sphere.observation.depth[i] = u < 110 ? 0.45f : 0.6f;
    sphere.mask[i] = 1;
  }
  NormalFitter().fit(sphere.mask, 0.004, sphere.observation);
  for (const std::int32_t i : sphere.observation.hand_pixels) ASSERT_LT(sphere.observation.normal[i].z(), -0.999f);
}

TEST(NoiseMeter, FindsTheNoiseOfACurvedSurface) {
  NoiseMeter meter;
  for (const double sigma : {0.0006, 0.0015}) {
    const Sphere sphere(sigma);
    EXPECT_NEAR(meter.measure(sphere.mask, sphere.observation.depth, 1e-5), sigma, 0.1 * sigma);
  }
  const Sphere exact(0);
  EXPECT_EQ(meter.measure(exact.mask, exact.observation.depth, 3e-4), 3e-4);
}

}  // namespace
}  // namespace barehand
