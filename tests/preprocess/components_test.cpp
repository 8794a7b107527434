#include "stages/preprocess/image/components.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

namespace barehand {
namespace {

/// A grid of 40 x 30 cells with the depth 0.5 m.
CoarseGrid flat_grid() {
  CoarseGrid grid;
  grid.camera = {40, 30, 60, 60, 20, 15};
  grid.z.reset(40, 30, 0.5f);
  return grid;
}

TEST(SplitSurfaces, OfOneDepthAreConnectedComponents) {
  const CoarseGrid grid = flat_grid();
  std::mt19937 random(5);
  Components found;
  for (const int share : {10, 30, 40, 50, 70}) {  // per cent; near 40 there are components of all sizes and shapes
    Image<std::uint8_t> mask(40, 30);
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = static_cast<int>(random() % 100) < share;
    cv::Mat labels;
    const int count = cv::connectedComponents(cv::Mat(30, 40, CV_8U, mask.data()), labels) - 1;
    split_surfaces(grid, mask, found);
    ASSERT_EQ(found.parts.size(), static_cast<std::size_t>(count)) << share << " %";
    std::vector<int> cells(found.parts.size());
    std::vector<int> label(found.parts.size(), -1);
    for (int v = 0; v < 30; ++v)
      for (int u = 0; u < 40; ++u) {
        const std::int32_t part = found.id.at(u, v);
        ASSERT_EQ(part >= 0, mask.at(u, v) != 0);
        if (part < 0) continue;
        ++cells[part];
        if (label[part] < 0) label[part] = labels.at<int>(v, u);
        ASSERT_EQ(labels.at<int>(v, u), label[part]) << share << " %, cell " << u << " " << v;
      }
    for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(found.parts[i].cells, cells[i]);
  }
}

TEST(SplitSurfaces, AStepInDepthPartsThem) {
  CoarseGrid grid = flat_grid();
  for (int v = 0; v < 30; ++v)
    for (int u = 0; u < 10; ++u) grid.z.at(u, v) = 0.4f;
  Components found;
  split_surfaces(grid, Image<std::uint8_t>(40, 30, 1), found);
  ASSERT_EQ(found.parts.size(), 2u);
  EXPECT_EQ(found.parts[0].cells, 10 * 30);
  EXPECT_EQ(found.parts[1].cells, 30 * 30);
  EXPECT_NEAR(found.parts[0].mean_z, 0.4f, 1e-4f);
  EXPECT_NEAR(found.parts[1].mean_z, 0.5f, 1e-4f);
  EXPECT_NEAR(found.parts[0].area, 10 * 30 * 0.4 * 0.4 / (60 * 60), 1e-4);
}

}  // namespace
}  // namespace barehand
