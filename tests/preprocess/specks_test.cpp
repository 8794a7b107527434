#include "stages/preprocess/image/specks.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

namespace barehand {
namespace {

constexpr double kSpeckArea = 3e-5;  // m^2

/// Intrinsics with which a component at a depth of 0.5 m needs this number of pixels to be kept.
Intrinsics camera_for(int pixels) {
  const double f = std::sqrt(pixels * 0.25 / kSpeckArea);
  return {64, 48, f, f, 32, 24};
}

/// Reference implementation with OpenCV.
Image<std::uint8_t> without_specks(const Intrinsics& camera, const Image<float>& depth, Image<std::uint8_t> mask) {
  cv::Mat labels, stats, centroids;
  cv::connectedComponentsWithStats(cv::Mat(mask.height(), mask.width(), CV_8U, mask.data()), labels, stats, centroids);
  for (int v = 0; v < mask.height(); ++v)
    for (int u = 0; u < mask.width(); ++u) {
      const int part = labels.at<int>(v, u);
      const float z =
          depth.at(static_cast<int>(centroids.at<double>(part, 0)), static_cast<int>(centroids.at<double>(part, 1)));
      const double least = kSpeckArea * camera.fx * camera.fy / (z > 0 ? z * z : 0.25);
      if (stats.at<int>(part, cv::CC_STAT_AREA) < least) mask.at(u, v) = 0;
    }
  return mask;
}

TEST(SpeckRemover, AgreesWithConnectedComponents) {
  std::mt19937 random(11);
  SpeckRemover remover;
  int cleared = 0, kept = 0;
  for (const int share : {5, 30, 40, 45, 60})  // per cent; near 40 there are components of all sizes and shapes
    for (const int least : {2, 9, 40}) {
      Image<std::uint8_t> mask(53 + share % 7, 37 + least);
      Image<float> depth(mask.width(), mask.height());
      for (std::size_t i = 0; i < mask.size(); ++i) {
        mask[i] = static_cast<int>(random() % 100) < share;
        depth[i] = random() % 5 == 0 ? 0.f : 0.3f + 0.1f * static_cast<float>(random() % 5);
      }
      const Intrinsics camera = camera_for(least);
      const Image<std::uint8_t> expected = without_specks(camera, depth, mask);
      Image<std::uint8_t> found = mask;
      remover.remove(camera, depth, found);
      for (std::size_t i = 0; i < mask.size(); ++i) {
        ASSERT_EQ(found[i], expected[i]) << share << " % " << least << " pixels, pixel " << i;
        cleared += mask[i] && !found[i];
        kept += found[i];
      }
    }
  EXPECT_GT(cleared, 1000);
  EXPECT_GT(kept, 1000);
}

TEST(SpeckRemover, AnEmptyMaskStaysEmpty) {
  Image<std::uint8_t> mask;
  SpeckRemover().remove(camera_for(1), {}, mask);
  EXPECT_TRUE(mask.empty());
}

}  // namespace
}  // namespace barehand
