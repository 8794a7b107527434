#include "math/fast_math.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

TEST(FastExp, AgreesWithTheLibraryOverItsRange) {
  for (float x = 0; x > -86.9f; x -= 0.00137f) {
    const double expected = std::exp(static_cast<double>(x));
    ASSERT_NEAR(fast_exp(x) / expected, 1, 3e-7) << "x = " << x;
  }
}

TEST(FastExp, IsExactlyOneAtZeroAndZeroFarBelow) {
  EXPECT_EQ(fast_exp(0.0f), 1.0f);
  EXPECT_EQ(fast_exp(-88.0f), 0.0f);
  EXPECT_EQ(fast_exp(-1e30f), 0.0f);
}

TEST(FastAtan2, AgreesWithTheLibraryAllAround) {
  for (float a = -3.14159f; a < 3.1416f; a += 0.00071f)
    for (float r : {1e-6f, 0.3f, 1.0f, 1e4f}) {
      const float y = r * std::sin(a), x = r * std::cos(a);
      ASSERT_NEAR(fast_atan2(y, x), std::atan2(static_cast<double>(y), static_cast<double>(x)), 4e-7)
          << "y = " << y << ", x = " << x;
    }
}

TEST(FastAtan2, IsDefinedAtTheOriginAndOnTheAxes) {
  EXPECT_EQ(fast_atan2(0.0f, 0.0f), 0.0f);
  EXPECT_FLOAT_EQ(fast_atan2(0.0f, -1.0f), std::numbers::pi_v<float>);
  EXPECT_FLOAT_EQ(fast_atan2(1.0f, 0.0f), std::numbers::pi_v<float> / 2);
  EXPECT_FLOAT_EQ(fast_atan2(-1.0f, 0.0f), -std::numbers::pi_v<float> / 2);
}

}  // namespace
}  // namespace barehand
