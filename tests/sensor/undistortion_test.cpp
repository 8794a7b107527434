#include "sensor/undistortion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace barehand {
namespace {

constexpr Intrinsics kCamera{160, 120, 130, 130, 79.5, 59.5};

/// A distorted depth image of a plane perpendicular to the camera's axis. The depth values encode the column at which
/// an ideal camera would see the point.
Image<std::uint16_t> seen_through(const Distortion& lens) {
  Image<std::uint16_t> image(kCamera.width, kCamera.height);
  const int fine = 8;  // number of ideal positions per pixel along each axis
  for (int v = 0; v < fine * kCamera.height; ++v) {
    for (int u = 0; u < fine * kCamera.width; ++u) {
      const double ideal_u = static_cast<double>(u) / fine, ideal_v = static_cast<double>(v) / fine;
      const Eigen::Vector2d there =
          lens.distorted((ideal_u - kCamera.cx) / kCamera.fx, (ideal_v - kCamera.cy) / kCamera.fy);
      const auto du = std::lround(kCamera.fx * there.x() + kCamera.cx),
                 dv = std::lround(kCamera.fy * there.y() + kCamera.cy);
      if (image.contains(static_cast<int>(du), static_cast<int>(dv)))
        image.at(static_cast<int>(du), static_cast<int>(dv)) = static_cast<std::uint16_t>(std::lround(1000 + ideal_u));
    }
  }
  return image;
}

// The expected numbers were computed by cv::projectPoints.
TEST(Distortion, IsThatOfOpenCv) {
  const auto expect = [](const Distortion& lens, double x, double y, double to_x, double to_y) {
    EXPECT_NEAR(lens.distorted(x, y).x(), to_x, 1e-8);
    EXPECT_NEAR(lens.distorted(x, y).y(), to_y, 1e-8);
  };
  const Distortion plumb_bob{-0.25, 0.07, 0.001, -0.002, 0.01};
  expect(plumb_bob, 0.3, -0.2, 0.289871491, -0.193290994);
  expect(plumb_bob, -0.5, 0.4, -0.457198105, 0.365512484);
  const Distortion rational{0.6, -2.1, 0.0005, -0.0003, 1.4, 0.5, -1.9, 1.3};
  expect(rational, 0.3, -0.2, 0.302697032, -0.201759022);
  expect(rational, -0.5, 0.4, -0.50779047, 0.406338976);
}

TEST(Undistortion, BringsEveryPixelBackToItsRay) {
  for (const double k1 : {-0.25, 0.2}) {
    const Distortion lens{k1};
    const Image<std::uint16_t> out = Undistortion(kCamera, lens).apply(seen_through(lens));
    int checked = 0;
    for (int v = 10; v < kCamera.height - 10; v += 5) {
      for (int u = 10; u < kCamera.width - 10; u += 5) {
        if (out.at(u, v) == 0) continue;
        EXPECT_NEAR(out.at(u, v), 1000 + u, 1.6) << u << " " << v;
        ++checked;
      }
    }
    EXPECT_GT(checked, 400);
  }
}

TEST(Undistortion, NeverMixesDepths) {
  Image<std::uint16_t> edge(kCamera.width, kCamera.height, 500);
  for (int v = 0; v < edge.height(); ++v)
    for (int u = 0; u < 70; ++u) edge.at(u, v) = 900;
  const Image<std::uint16_t> out = Undistortion(kCamera, {-0.3, 0.1}).apply(edge);
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_TRUE(out[i] == 0 || out[i] == 500 || out[i] == 900) << out[i];
}

TEST(Undistortion, WithoutCoefficientsNothingMoves) {
  const Undistortion none(kCamera, {});
  EXPECT_LT(none.largest_shift(), 1e-9);
  EXPECT_EQ(none.shown(), 1);
  const Image<std::uint16_t> image = seen_through({});
  const Image<std::uint16_t> out = none.apply(image);
  for (std::size_t i = 0; i < out.size(); ++i) ASSERT_EQ(out[i], image[i]);
}

TEST(Undistortion, CoefficientsOfNoLensShowNextToNothing) {
  EXPECT_LT(Undistortion(kCamera, {-40}).shown(), 0.5) << "the picture turns round near its middle";
  EXPECT_LT(Undistortion(kCamera, {1e9}).shown(), 0.5);
  EXPECT_LT(Undistortion(kCamera, {NAN}).shown(), 0.5);
}

}  // namespace
}  // namespace barehand
