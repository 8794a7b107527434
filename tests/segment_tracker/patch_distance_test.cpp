#include "stages/segment_tracker/patch_distance.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "math/random.h"
#include "support/scene.h"

namespace barehand {
namespace {

constexpr int kSegment = 6;
using HiddenPixels = Image<std::uint8_t>;

/// Sec. 4.1 and 4.2 of the paper, evaluated for each point in double precision, from the observation instead of the
/// pixel map.
PatchDistance reference_distance(const SegmentSurface& skin, const SE3& T, const HandObservation& o,
                                 const HiddenPixels& hidden, bool missing_is_background, double cap) {
  const Intrinsics& c = o.frame->camera;
  double distance = 0, counted = 0, total = 0;
  for (std::size_t i = 0; i < skin.size(); ++i) {
    // The pixels that the point covers.
    const Eigen::Vector3d p = T * Eigen::Vector3d(skin.x[i], skin.y[i], skin.z[i]);
    const double facing = -(T.R * Eigen::Vector3d(skin.nx[i], skin.ny[i], skin.nz[i])).dot(p);
    if (facing <= 0) continue;
    const double weight = skin.area[i] * facing / std::pow(p.z(), 3) * c.fx * c.fy;
    total += weight;

    // The data at this pixel; hidden points do not count.
    const Eigen::Vector2d pixel = c.project(p);
    const int u = static_cast<int>(std::floor(pixel.x() + 0.5)), v = static_cast<int>(std::floor(pixel.y() + 0.5));
    if (!o.label.contains(u, v) || hidden.at(u, v)) continue;
    const double z_data = o.depth.at(u, v);

    // Eq. 1.
    double d = std::abs(p.z() - z_data);
    if (o.label.at(u, v) != PixelLabel::hand) {
      if (o.label.at(u, v) == PixelLabel::unknown && !missing_is_background) continue;
      if (z_data > 0 && z_data < p.z()) continue;
      d = (p - o.point(o.nearest_hand.at(u, v)).cast<double>()).norm();
    }
    distance += weight * std::min(d, cap);
    counted += weight;
  }
  return {static_cast<float>(distance), static_cast<float>(counted), static_cast<float>(total)};
}

/// An observation with random labels and with depths around that of the segment. All of the skin is within the image.
HandObservation random_scene(std::uint64_t seed) {
  KeyedRandom random(seed, 3);
  return make_observation(small_camera(64, 64), [&](int, int) -> ScenePixel {
    const double kind = random.uniform();
    const float z = static_cast<float>(random.uniform(0.37, 0.42));
    if (kind < 0.4) return {z, PixelLabel::hand};
    if (kind < 0.6) return {z, PixelLabel::object};
    if (kind < 0.8) return {kind < 0.7 ? 1.0f : z, PixelLabel::background};
    return {0, PixelLabel::unknown};
  });
}

TEST(PatchDistance, AgreesWithTheEquationsPointByPoint) {
  const SegmentSurface skin = make_cylinder_surface(capsule_profile(), 83)[kSegment];  // not a multiple of a SIMD width
  Workers workers(1);
  constexpr int kScenes = 24;
  double counted = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    // A random scene and pose.
    const HandObservation o = random_scene(seed);
    const bool missing_is_background = seed % 2;
    const double cap = seed % 4 < 2 ? 0.01 : std::numeric_limits<double>::infinity();
    PixelMap map = make_pixel_map(o, missing_is_background, workers);

    // Random pixels are hidden from the segment.
    HiddenPixels hidden(64, 64, 0);
    KeyedRandom random(seed, 4);
    for (int v = 0; v < 64; ++v)
      for (int u = 0; u < 64; ++u) {
        hidden.at(u, v) = random.uniform() < 0.1;
        map.hidden[map.index(u + 1, v + 1)] = hidden.at(u, v) ? 1 << kSegment : ~(1 << kSegment);
      }
    SE3 T = upright_pose();
    const double x = random.uniform(-0.02, 0.02), y = random.uniform(-0.02, 0.02), turn = random.uniform(-1, 1);
    T = boxplus(T, (Vector6d() << x, y, 0.005, turn, -turn, 2 * turn).finished());

    const PatchDistance actual = patch_distance(skin, T, kSegment, map, static_cast<float>(cap));
    const PatchDistance expected = reference_distance(skin, T, o, hidden, missing_is_background, cap);
    // Rounding to single precision may move a point across a pixel's border or the silhouette.
    ASSERT_NEAR(actual.total, expected.total, 1e-3 * expected.total) << "seed " << seed;
    ASSERT_NEAR(actual.counted, expected.counted, 1e-3 * expected.total) << "seed " << seed;
    ASSERT_NEAR(actual.mean(), expected.mean(), 2e-5) << "seed " << seed;
    counted += expected.counted_fraction() / kScenes;
  }
  EXPECT_GT(counted, 0.2);  // some points count, others do not
  EXPECT_LT(counted, 0.8);
}

PatchDistance compare_with(const std::function<ScenePixel(int, int)>& scene, const SE3& T) {
  Workers workers(1);
  const PixelMap map = make_pixel_map(make_observation(small_camera(), scene), false, workers);
  return patch_distance(make_cylinder_surface(capsule_profile(), 400)[kSegment], T, kSegment, map, 1.0f);
}

TEST(PatchDistance, WeightsAddUpToTheCoveredPixels) {
  // The silhouette of the tip: a rectangle of 16 mm by 30 mm and half a disc, nearly parallel to the image.
  const double silhouette = (0.016 * 0.030 + std::numbers::pi * 0.008 * 0.008 / 2) * 525 * 525 / (0.4 * 0.4);
  const PatchDistance d = compare_with([](int, int) { return ScenePixel{0.4f, PixelLabel::hand}; }, upright_pose());
  EXPECT_NEAR(d.total, silhouette, 0.05 * silhouette);
}

TEST(PatchDistance, OnHandPixelsIsTheDepthDifference) {
  // A wall of skin is 30 mm behind the axis; the visible skin is in front of the axis by up to the radius.
  const PatchDistance d = compare_with([](int, int) { return ScenePixel{0.43f, PixelLabel::hand}; }, upright_pose());
  EXPECT_GT(d.mean(), 0.030);
  EXPECT_LT(d.mean(), 0.038);
}

TEST(PatchDistance, SkinInFrontOfAnObjectIsNotHiddenByIt) {
  const auto object_at = [](float z) {
    return [z](int u, int) { return u < 3 ? ScenePixel{0.4f, PixelLabel::hand} : ScenePixel{z, PixelLabel::object}; };
  };
  EXPECT_EQ(compare_with(object_at(0.35f), upright_pose()).counted, 0);
  EXPECT_GT(compare_with(object_at(0.45f), upright_pose()).counted_fraction(), 0.99);
}

TEST(PatchDistance, OutsideTheCameraImageNothingIsCounted) {
  SE3 T = upright_pose();
  T.t.x() = 0.5;
  const PatchDistance d = compare_with([](int, int) { return ScenePixel{0.4f, PixelLabel::hand}; }, T);
  EXPECT_GT(d.total, 0);
  EXPECT_EQ(d.counted, 0);
}

TEST(PatchDistance, BehindTheCameraThereIsNoSkin) {
  const PatchDistance d = compare_with([](int, int) { return ScenePixel{0.4f, PixelLabel::hand}; }, upright_pose(-0.4));
  EXPECT_EQ(d.total, 0);
}

}  // namespace
}  // namespace barehand
