#include "observe/dense/nearest_cell.h"

#include <gtest/gtest.h>

#include <limits>

#include "math/random.h"

namespace barehand {
namespace {

int distance_sq(const Image<std::int32_t>& image, int u, int v, std::int32_t cell) {
  const int du = cell % image.width() - u, dv = cell / image.width() - v;
  return du * du + dv * dv;
}

TEST(NearestCell, IsAsNearAsBruteForce) {
  // A few occupied cells.
  Image<std::int32_t> occupied(41, 33, -1);
  KeyedRandom random(1, 2);
  for (int i = 0; i < 60; ++i) occupied[random.bits() % occupied.size()] = 5;
  NearestCell nearest;
  nearest.index(occupied);

  // The distance to the nearest cell equals that found by brute force.
  for (int v = 0; v < occupied.height(); ++v)
    for (int u = 0; u < occupied.width(); ++u) {
      int best = std::numeric_limits<int>::max();
      for (std::size_t i = 0; i < occupied.size(); ++i)
        if (occupied[i] >= 0) best = std::min(best, distance_sq(occupied, u, v, static_cast<std::int32_t>(i)));
      const std::int32_t found = nearest.find(u, v);
      ASSERT_GE(found, 0);
      ASSERT_GE(occupied[found], 0);
      EXPECT_EQ(distance_sq(occupied, u, v, found), best) << u << "," << v;
    }
}

TEST(NearestCell, SaysSoWhenNothingIsOccupied) {
  NearestCell nearest;
  nearest.index(Image<std::int32_t>(4, 3, -1));
  for (int v = 0; v < 3; ++v)
    for (int u = 0; u < 4; ++u) EXPECT_EQ(nearest.find(u, v), -1);
}

TEST(NearestCell, ForgetsThePictureBefore) {
  Image<std::int32_t> occupied(5, 4, -1);
  occupied.at(4, 3) = 0;
  NearestCell nearest;
  nearest.index(occupied);
  EXPECT_EQ(nearest.find(0, 0), static_cast<std::int32_t>(occupied.index(4, 3)));
  occupied.at(4, 3) = -1;
  occupied.at(1, 2) = 0;
  nearest.index(occupied);
  EXPECT_EQ(nearest.find(4, 3), static_cast<std::int32_t>(occupied.index(1, 2)));
}

}  // namespace
}  // namespace barehand
