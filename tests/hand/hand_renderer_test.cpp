#include "hand/rendering/hand_renderer.h"

#include <limits>

#include "support/adult_hand.h"

namespace barehand {
namespace {

const Intrinsics kCamera{320, 240, 262.0, 262.0, 159.5, 119.5};

// Depth of the nearest triangle that faces the camera along the ray of a pixel (Moeller-Trumbore); 0 = none.
double ray_cast(const Skin& skin, const std::vector<Eigen::Vector3f>& posed, const Eigen::Vector3d& ray) {
  double nearest = std::numeric_limits<double>::max();
  for (const auto& t : skin.triangles) {
    const Eigen::Vector3d a = posed[t[0]].cast<double>(), ab = posed[t[1]].cast<double>() - a,
                          ac = posed[t[2]].cast<double>() - a;
    const Eigen::Vector3d p = ray.cross(ac);
    const double det = ab.dot(p);
    if (det < 1e-14) continue;  // the triangle faces away

    const double u = -a.dot(p) / det;
    const Eigen::Vector3d q = (-a).cross(ab);
    const double v = ray.dot(q) / det, depth = ac.dot(q) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && depth > 0) nearest = std::min(nearest, depth);
  }
  return nearest == std::numeric_limits<double>::max() ? 0 : nearest;
}

TEST(RenderHand, AgreesWithRayCasting) {
  // Render a hand.
  const auto profile = test::adult_hand();
  const Skin skin = make_blended_skin(*profile, 0.005);
  const HandPose pose = test::facing_pose(*profile, 0.45, 0.9);
  RenderedHand rendered;
  render_hand(skin, pose, kCamera, {7, 3, 3, 100, 75}, rendered);

  // Compare every second cell with a ray through its centre.
  int covered = 0, differ = 0;
  for (int j = 0; j < 75; j += 2)
    for (int i = 0; i < 100; i += 2) {
      const double expected = ray_cast(skin, rendered.position, kCamera.unproject(7 + 3 * i, 3 + 3 * j, 1.0));
      const double depth = rendered.depth.at(i, j);
      if ((expected > 0) != (depth > 0)) {
        ++differ;  // a ray may hit an edge exactly
      } else {
        EXPECT_NEAR(depth, expected, 1e-4) << i << "," << j;
      }
      covered += expected > 0;
    }
  EXPECT_GT(covered, 50);
  EXPECT_LE(differ, 1);
}

TEST(RenderHand, CountsHiddenSkinAsProjected) {
  const auto profile = test::adult_hand();
  const Skin skin = make_blended_skin(*profile, 0.005);
  RenderedHand rendered;
  const CellGrid grid{0, 0, 1, 320, 240};
  render_hand(skin, test::facing_pose(*profile, 0.45, 1.4), kCamera, grid, rendered);
  std::array<int, kSegmentCount> front{};
  for (std::size_t i = 0; i < rendered.vertex.size(); ++i)
    if (rendered.vertex[i] >= 0) ++front[skin.vertices[rendered.vertex[i]].a];
  const int proximal = segment_of(2, 0);  // hidden by the curled fingertips
  EXPECT_LT(front[proximal], rendered.projected[proximal] / 2);
}

TEST(RenderHand, CountsSkinBeyondTheBorderAsProjected) {
  const auto profile = test::adult_hand();
  const Skin skin = make_blended_skin(*profile, 0.005);
  const HandPose pose = test::facing_pose(*profile, 0.45);

  // Render the whole hand, then with the border of the image across it, which the grid reaches or not.
  RenderedHand whole, cut;
  render_hand(skin, pose, kCamera, {0, 0, 1, 320, 240}, whole);
  Intrinsics narrow = kCamera;
  narrow.width = 160;
  for (const int columns : {160, 100}) {
    render_hand(skin, pose, narrow, {0, 0, 1, columns, 240}, cut);
    int mostly_beyond = 0;
    for (int s = 0; s < kSegmentCount; ++s) {
      // Triangles on the border are counted roughly. A grid that ends before it leaves out some skin inside the image.
      const double tolerance = 10 + 0.1 * whole.projected[s];
      EXPECT_LT(cut.projected[s], whole.projected[s] + tolerance) << s;
      if (columns == narrow.width) {
        EXPECT_GT(cut.projected[s], whole.projected[s] - tolerance) << s;
      }
      EXPECT_EQ(whole.beyond[s], 0) << s;
      mostly_beyond += cut.beyond[s] > 0.9f * cut.projected[s];
    }
    EXPECT_GE(mostly_beyond, 6) << "two fingers";
    EXPECT_LE(mostly_beyond, 10);
  }
}

}  // namespace
}  // namespace barehand
