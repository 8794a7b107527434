#include "observe/sampled/pixel_map.h"

#include <gtest/gtest.h>

#include "support/scene.h"

namespace barehand {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A map of one row: hand, background, object, unknown.
PixelMap four_labels(bool missing_is_background) {
  Workers workers(1);
  const ScenePixel row[] = {
      {0.4f, PixelLabel::hand}, {1.0f, PixelLabel::background}, {0.3f, PixelLabel::object}, {0, PixelLabel::unknown}};
  const HandObservation o = make_observation(small_camera(4, 1), [&](int u, int) { return row[u]; });
  return make_pixel_map(o, missing_is_background, workers);
}

TEST(PixelMap, HandPixelHoldsItsOwnPoint) {
  const PixelMap map = four_labels(false);
  const PixelMap::Cell& cell = map.cells[map.index(1, 1)];
  EXPECT_FLOAT_EQ(cell.z, 0.4f);
  EXPECT_FLOAT_EQ(cell.x, -1.5f / 525 * 0.4f);
  EXPECT_EQ(cell.occluder_z, kInfinity);
}

TEST(PixelMap, OtherDataHoldsTheNearestHandPointAndHidesWhatIsBehind) {
  const PixelMap map = four_labels(false);
  for (const auto& [u, occluder] : {std::pair{2, 1.0f}, {3, 0.3f}}) {
    const PixelMap::Cell& cell = map.cells[map.index(u, 1)];
    EXPECT_FLOAT_EQ(cell.z, -0.4f);
    EXPECT_FLOAT_EQ(cell.x, -1.5f / 525 * 0.4f);
    EXPECT_FLOAT_EQ(cell.occluder_z, occluder);
  }
}

TEST(PixelMap, MissingDepthIsSilentOrNotHandAsConfigured) {
  EXPECT_EQ(four_labels(false).cells[four_labels(false).index(4, 1)].occluder_z, -kInfinity);
  const PixelMap paper = four_labels(true);
  EXPECT_EQ(paper.cells[paper.index(4, 1)].occluder_z, kInfinity);
  EXPECT_FLOAT_EQ(paper.cells[paper.index(4, 1)].z, -0.4f);
}

TEST(PixelMap, BorderIsNotHandWithinTheCameraImageAndSilentOutside) {
  Workers workers(1);
  HandObservation o = make_observation(small_camera(3, 3), [](int, int) { return ScenePixel{0.4f, PixelLabel::hand}; });
  auto frame = std::make_shared<RgbdFrame>();
  frame->camera = {4, 3, 525, 525, 1, 1};  // the region of interest is the right part of a wider image
  o.frame = frame;
  o.u0 = 1;
  const PixelMap map = make_pixel_map(o, false, workers);
  EXPECT_EQ(map.cells[map.index(0, 2)].occluder_z, kInfinity);
  EXPECT_LT(map.cells[map.index(0, 2)].z, 0);
  EXPECT_EQ(map.cells[map.index(4, 2)].occluder_z, -kInfinity);
}

TEST(PixelMap, WithoutAnyHandPixelNothingIsSaid) {
  Workers workers(1);
  const HandObservation o = make_observation(small_camera(2, 2), [](int, int) {
    return ScenePixel{1, PixelLabel::background};
  });
  for (const PixelMap::Cell& cell : make_pixel_map(o, true, workers).cells) EXPECT_EQ(cell.occluder_z, -kInfinity);
}

}  // namespace
}  // namespace barehand
