#include "drivers/synthetic/rendering/depth_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "drivers/synthetic/rendering/depth_loss.h"

namespace barehand::synthetic {
namespace {

const Intrinsics kCamera = {160, 120, 131.25, 131.25, 79.5, 59.5};
const std::vector<Material> kMaterials = {{{200, 200, 200}, 0.0}};

RenderedView wall(double z, Rgb colour = {180, 160, 150}, float cosine = 1) {
  const int w = kCamera.width, h = kCamera.height;
  return {Image<float>(w, h, static_cast<float>(z)), Image<float>(w, h, cosine), Image<std::uint8_t>(w, h, 0),
          Image<Rgb>(w, h, colour)};
}

struct Spread {
  double mean = 0, sigma = 0, missing = 0;
};
Spread spread(const Image<float>& depth) {
  double sum = 0, sum_sq = 0;
  int n = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (depth[i] == 0) continue;
    sum += depth[i];
    sum_sq += static_cast<double>(depth[i]) * depth[i];
    ++n;
  }
  return {sum / n, std::sqrt(sum_sq / n - sum / n * sum / n), 1 - n / static_cast<double>(depth.size())};
}

/// Whether the axial standard deviation of this depth image of a flat wall is `sigma` [m] within 5 %.
bool has_sigma(const Image<float>& depth, double sigma) { return std::abs(spread(depth).sigma / sigma - 1) < 0.05; }

TEST(KinectNoise, HasThePublishedAxialSigma) {
  for (const double z : {0.4, 0.7, 1.2}) {
    const auto depth = DepthNoise().kinect(kCamera, wall(z), kMaterials, {}, 5, 0);
    const double expected = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);
    EXPECT_TRUE(has_sigma(depth, expected)) << z << ": " << spread(depth).sigma << " against " << expected;
    EXPECT_NEAR(spread(depth).mean, z, 1e-4);
  }
}

TEST(KinectNoise, CheckRejectsAWrongSigma) {
  KinectNoise wrong;
  wrong.axial = 0.0015;
  EXPECT_FALSE(has_sigma(DepthNoise().kinect(kCamera, wall(0.4), kMaterials, wrong, 5, 0), 0.0012));
}

TEST(KinectNoise, LateralJitterRoughensSlopes) {
  RenderedView slope = wall(0.6);
  for (int v = 0; v < kCamera.height; ++v)
    for (int u = 0; u < kCamera.width; ++u) slope.depth.at(u, v) = 0.5f + 0.003f * static_cast<float>(u);
  Image<float> residual = DepthNoise().kinect(kCamera, slope, kMaterials, {}, 5, 0);
  for (int v = 0; v < kCamera.height; ++v)
    for (int u = 0; u < kCamera.width; ++u)
      if (residual.at(u, v) > 0) residual.at(u, v) += 1 - slope.depth.at(u, v);
  // 0.8 pixels on a slope of 3 mm per pixel, plus the axial noise.
  const double axial = kinect_axial_sigma({}, 0.74);
  EXPECT_NEAR(spread(residual).sigma, std::hypot(0.8 * 0.003, axial), 0.0005);
}

TEST(KinectNoise, LosesDarkAndGrazingSurfacesInPatches) {
  // Dark and grazing surfaces lose more pixels.
  const DepthNoise noise;
  const double fair = spread(noise.kinect(kCamera, wall(0.6), kMaterials, {}, 5, 0)).missing;
  const auto dark = noise.kinect(kCamera, wall(0.6, {10, 10, 12}), kMaterials, {}, 5, 0);
  const double grazing = spread(noise.kinect(kCamera, wall(0.6, {180, 160, 150}, 0.08f), kMaterials, {}, 5, 0)).missing;
  EXPECT_LT(fair, 0.01);
  EXPECT_GT(spread(dark).missing, 0.1);
  EXPECT_GT(grazing, 0.3);

  // The losses are clustered: the neighbour of a lost pixel is lost far more often than any other pixel.
  int lost = 0, beside_lost = 0;
  for (int v = 0; v < kCamera.height; ++v)
    for (int u = 0; u + 1 < kCamera.width; ++u) {
      if (dark.at(u, v) != 0) continue;
      ++lost;
      beside_lost += dark.at(u + 1, v) == 0;
    }
  EXPECT_GT(static_cast<double>(beside_lost) / lost, 1.5 * spread(dark).missing);
}

TEST(KinectNoise, LeavesABandWithoutDataBesideAnEdge) {
  // A near surface in front of a wall.
  RenderedView step = wall(0.9);
  for (int v = 0; v < kCamera.height; ++v)
    for (int u = 80; u < 120; ++u) step.depth.at(u, v) = 0.5f;
  const auto depth = DepthNoise().kinect(kCamera, step, kMaterials, {}, 5, 0);

  // The projector is on the right, so its shadow is to the left of the near surface: baseline * f * (1/0.5 - 1/0.9)
  // wide.
  const int band = static_cast<int>(0.075 * kCamera.fx * (1 / 0.5 - 1 / 0.9));
  int in_band = 0, beyond = 0;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 80 - band + 1; u < 80; ++u) in_band += depth.at(u, v) == 0;
    for (int u = 40; u < 60; ++u) beyond += depth.at(u, v) == 0;
  }
  EXPECT_GT(in_band, 0.95 * (band - 1) * kCamera.height);
  EXPECT_LT(beyond, 0.02 * 20 * kCamera.height);
}

TEST(KinectNoise, IsAFunctionOfSeedAndFrame) {
  const DepthNoise noise;
  const auto depth = [&](std::uint64_t seed, std::uint32_t frame) {
    const auto image = noise.kinect(kCamera, wall(0.6), kMaterials, {}, seed, frame);
    return std::vector<float>(image.data(), image.data() + image.size());
  };
  EXPECT_EQ(depth(1, 2), depth(1, 2));
  EXPECT_NE(depth(1, 2), depth(2, 2));
  EXPECT_NE(depth(1, 2), depth(1, 3));
}

TEST(TofNoise, HasFlyingPixelsBetweenTheSurfacesOfAnEdgeAndNowhereElse) {
  // A near surface in front of a wall.
  RenderedView step = wall(0.9);
  for (int v = 0; v < kCamera.height; ++v)
    for (int u = 80; u < 120; ++u) step.depth.at(u, v) = 0.5f;
  const auto depth = DepthNoise().tof(step, {}, 5, 0);

  // Pixels between both depths occur at the edges only.
  int flying_at_edge = 0, flying_elsewhere = 0;
  for (int v = 0; v < kCamera.height; ++v)
    for (int u = 0; u < kCamera.width; ++u) {
      const bool flies = depth.at(u, v) > 0.53f && depth.at(u, v) < 0.87f;
      const bool at_edge = u == 79 || u == 80 || u == 119 || u == 120;
      (at_edge ? flying_at_edge : flying_elsewhere) += flies;
    }
  EXPECT_NEAR(flying_at_edge / (4.0 * kCamera.height), 0.6 * 0.85, 0.08);
  EXPECT_EQ(flying_elsewhere, 0);
}

TEST(TofNoise, GrowsWithDistanceAndDarkness) {
  const DepthNoise noise;
  const auto sigma = [&](double z, Rgb colour) { return spread(noise.tof(wall(z, colour), {}, 5, 0)).sigma; };
  EXPECT_NEAR(sigma(0.5, {255, 255, 255}), 0.0012, 0.0001);
  EXPECT_NEAR(sigma(1.0, {255, 255, 255}), 0.0024, 0.0002);
  EXPECT_GT(sigma(0.5, {60, 60, 60}), 0.002);
}

}  // namespace
}  // namespace barehand::synthetic
