#include "observe/nearest_cell.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/random.h"

namespace barehand {
namespace {

TEST(NearestOccupied, IsWithinATenthOfACellOfBruteForce) {
  Image<std::int32_t> occupied(41, 33, -1);
  KeyedRandom random(1, 2);
  for (int i = 0; i < 60; ++i) occupied[random.bits() % occupied.size()] = 5;
  Image<std::int32_t> nearest;
  nearest_occupied(occupied, nearest);
  for (int v = 0; v < occupied.height(); ++v)
    for (int u = 0; u < occupied.width(); ++u) {
      double best = std::numeric_limits<double>::max();
      for (int y = 0; y < occupied.height(); ++y)
        for (int x = 0; x < occupied.width(); ++x)
          if (occupied.at(x, y) >= 0) best = std::min(best, std::hypot(x - u, y - v));
      const int found = nearest.at(u, v);
      ASSERT_GE(found, 0);
      ASSERT_GE(occupied[found], 0);
      EXPECT_NEAR(std::hypot(found % 41 - u, found / 41 - v), best, 0.1) << u << "," << v;
    }
}

TEST(NearestOccupied, SaysSoWhenNothingIsOccupied) {
  Image<std::int32_t> nearest;
  nearest_occupied(Image<std::int32_t>(4, 3, -1), nearest);
  for (std::size_t i = 0; i < nearest.size(); ++i) EXPECT_EQ(nearest[i], -1);
}

}  // namespace
}  // namespace barehand
