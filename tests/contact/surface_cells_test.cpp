#include "stages/contact/surface_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hand/skin.h"
#include "support/painted_hand.h"

namespace barehand {
namespace {

// Cells are three pixels wide here. A pencil of four pixels shares two cells, wherever it lies.
TEST(SurfaceCells, AThinThingIsSeenWhereverItLies) {
  const auto profile = test::adult_hand();
  const Skin skin = make_blended_skin(*profile, 0.005);
  const HandPose pose = test::facing_pose(*profile, 0.31);
  auto estimate = std::make_shared<HandEstimate>();
  for (int s = 0; s < kSegmentCount; ++s) estimate->segments[s].T_camera_segment = pose[s];

  for (int left = 0; left < 3; ++left) {
    const auto observation = test::observe_skin(skin, pose, 2.0);
    const int u0 = 285 + left, v0 = 90;
    for (int v = v0; v < v0 + 50; ++v)
      for (int u = u0; u < u0 + 4; ++u) {
        ASSERT_EQ(observation->label.at(u, v), PixelLabel::background);
        observation->label.at(u, v) = PixelLabel::object;
        observation->depth.at(u, v) = 0.31f;
      }

    SurfaceCells cells;
    std::vector<SurfacePoint> points;
    std::vector<bool> open;
    cells.collect(
        {observation}, {estimate}, 0, [](const Eigen::Vector3f&) { return true; }, points, open);
    EXPECT_EQ(open.size(), 1u) << left;
    EXPECT_GE(std::ranges::count_if(points, [](const SurfacePoint& p) { return std::abs(p.p.z() - 0.31f) < 1e-4f; }),
              14)
        << left;
  }
}

}  // namespace
}  // namespace barehand
