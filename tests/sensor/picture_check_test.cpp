#include "sensor/picture_check.h"

#include <gtest/gtest.h>

#include <random>

namespace barehand {
namespace {

using Depth = Image<std::uint16_t>;

/// Depth of a slanted wall with noise, and of a box in front of it.
Depth scene(unsigned seed) {
  std::minstd_rand random(seed);
  std::uniform_int_distribution<int> noise(-15, 15);
  Depth depth(160, 120);
  for (int v = 0; v < depth.height(); ++v)
    for (int u = 0; u < depth.width(); ++u)
      depth.at(u, v) = static_cast<std::uint16_t>((u > 40 && u < 90 && v > 30 ? 5000 : 9000 + 10 * u) + noise(random));
  return depth;
}

Depth noise(unsigned seed) {
  std::minstd_rand random(seed);
  Depth depth(160, 120);
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = static_cast<std::uint16_t>(random() >> 8);
  return depth;
}

TEST(PictureCheck, SurfacesAreSensibleAndNoiseIsNot) {
  EXPECT_EQ(check_depth(scene(1), nullptr), DepthFault::none);
  EXPECT_EQ(check_depth(noise(1), nullptr), DepthFault::senseless);
  EXPECT_LT(jump_fraction(scene(1)), 0.02);
  EXPECT_GT(jump_fraction(noise(1)), 0.6);
}

TEST(PictureCheck, HolesAreNoJumps) {
  Depth depth = scene(1);
  for (std::size_t i = 0; i < depth.size(); i += 3) depth[i] = 0;
  EXPECT_EQ(check_depth(depth, nullptr), DepthFault::none);
}

TEST(PictureCheck, OnlyTheVerySamePictureIsRepeated) {
  const Depth before = scene(1);
  EXPECT_EQ(check_depth(scene(1), &before), DepthFault::repeated);
  EXPECT_EQ(check_depth(scene(2), &before), DepthFault::none);
  Depth other = before;
  ++other.at(159, 119);
  EXPECT_EQ(check_depth(other, &before), DepthFault::none);
}

TEST(PictureCheck, NothingMeasuredIsEmptyHoweverOften) {
  const Depth nothing(160, 120);
  EXPECT_EQ(check_depth(nothing, &nothing), DepthFault::empty);
  Depth something = nothing;
  something.at(80, 60) = 5000;
  EXPECT_EQ(check_depth(something, nullptr), DepthFault::none);
}

}  // namespace
}  // namespace barehand
