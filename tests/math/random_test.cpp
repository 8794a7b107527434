#include "math/random.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

// The expected numbers are from the Random123 distribution (file kat_vectors, philox 4x32 10).
TEST(Philox, MatchesReferenceVectors) {
  EXPECT_EQ(Philox::block(0, {0, 0, 0, 0}),
            (std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(Philox::block(0xffffffffffffffff, {0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}),
            (std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
}

TEST(KeyedRandom, DependsOnEveryKey) {
  const auto first = [](std::uint64_t s, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return KeyedRandom(s, a, b, c).bits();
  };
  const auto base = first(1, 2, 3, 4);
  EXPECT_EQ(base, first(1, 2, 3, 4));
  EXPECT_NE(base, first(0, 2, 3, 4));
  EXPECT_NE(base, first(1, 0, 3, 4));
  EXPECT_NE(base, first(1, 2, 0, 4));
  EXPECT_NE(base, first(1, 2, 3, 0));
}

TEST(KeyedRandom, NormalHasUnitVariance) {
  KeyedRandom random(7, 1);
  double sum = 0, sum_sq = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    sum += x;
    sum_sq += x * x;
  }
  EXPECT_NEAR(sum / n, 0, 0.03);
  EXPECT_NEAR(sum_sq / n, 1, 0.04);
}

}  // namespace
}  // namespace barehand
