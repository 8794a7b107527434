#include "stages/preprocess/image/distance_transform.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace barehand {
namespace {

int distance_sq(int width, std::int32_t index, int u, int v) {
  const int du = index % width - u, dv = index / width - v;
  return du * du + dv * dv;
}

void expect_nearest_everywhere(const Image<std::uint8_t>& mask) {
  NearestPixelTransform transform;
  Image<std::int32_t> nearest;
  transform.compute(mask, nearest);
  for (int v = 0; v < mask.height(); ++v)
    for (int u = 0; u < mask.width(); ++u) {
      int best = std::numeric_limits<int>::max();
      for (std::size_t i = 0; i < mask.size(); ++i)
        if (mask[i]) best = std::min(best, distance_sq(mask.width(), static_cast<std::int32_t>(i), u, v));
      const std::int32_t found = nearest.at(u, v);
      ASSERT_GE(found, 0);
      ASSERT_TRUE(mask[found]);
      ASSERT_EQ(distance_sq(mask.width(), found, u, v), best) << u << "," << v;
    }
}

TEST(NearestPixelTransform, AgreesWithBruteForce) {
  std::mt19937 random(7);
  for (const int one_in : {2, 20, 200, 1500})
    for (int round = 0; round < 4; ++round) {
      Image<std::uint8_t> mask(53 - 3 * round, 37 + 5 * round);
      for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = random() % one_in == 0;
      mask[random() % mask.size()] = 1;
      expect_nearest_everywhere(mask);
    }
}

TEST(NearestPixelTransform, SinglePixelInACornerIsNearestToAll) {
  Image<std::uint8_t> mask(40, 30);
  mask.at(39, 0) = 1;
  expect_nearest_everywhere(mask);
}

TEST(NearestPixelTransform, EmptyMaskHasNoNearestPixel) {
  NearestPixelTransform transform;
  Image<std::int32_t> nearest;
  transform.compute(Image<std::uint8_t>(8, 5), nearest);
  for (std::size_t i = 0; i < nearest.size(); ++i) EXPECT_EQ(nearest[i], -1);
}

}  // namespace
}  // namespace barehand
