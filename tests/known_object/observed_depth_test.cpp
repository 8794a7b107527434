#include "stages/known_object/observed_depth.h"

#include <gtest/gtest.h>

#include "known_object/object_scene.h"

namespace barehand {
namespace {

/// An object before a wall, whose outermost pixels measure a place a little behind it, as time-of-flight cameras do.
class SmearedDepth : public testing::Test {
 protected:
  SmearedDepth() {
    scene_.object = object_.get();
    scene_.T_camera_object = {exp_so3({0.3, 0.2, 0.5}), {0, 0, 0.5}};
    const auto ideal = scene_.observe(0);
    auto frame = std::make_shared<RgbdFrame>(*ideal->frame);
    const auto is_wall = [&](int u, int v) { return ideal->label.at(u, v) == PixelLabel::background; };
    for (int v = 1; v + 1 < frame->depth.height(); ++v)
      for (int u = 1; u + 1 < frame->depth.width(); ++u)
        if (!is_wall(u, v) && (is_wall(u - 1, v) || is_wall(u + 1, v) || is_wall(u, v - 1) || is_wall(u, v + 1)))
          frame->depth.at(u, v) += static_cast<std::uint16_t>(kSmear / frame->depth_unit), ++smeared_;
    auto observation = std::make_shared<HandObservation>(*ideal);
    observation->frame = frame;
    observations_ = {observation};
  }

  static constexpr double kSmear = 0.012;  // [m]
  KnownObjectPtr object_ = make_known_object(test::hammer_mesh(), 1);
  test::ObjectScene scene_;
  HandObservations observations_;
  int smeared_ = 0;
};

TEST_F(SmearedDepth, PixelsAtEdgesAreNoPointsOfTheObject) {
  ASSERT_GT(smeared_, 100);
  std::vector<Eigen::Vector3f> points;
  ObservedDepth(observations_).points_near(*object_, scene_.T_camera_object, 0.02, 3000, points);
  EXPECT_GT(points.size(), 1000u);
  const SE3 T_object_camera = scene_.T_camera_object.inverse();
  for (const Eigen::Vector3f& p : points)
    EXPECT_LT(std::abs(object_->grid.distance((T_object_camera * p.cast<double>()).cast<float>())), 0.002f);
}

TEST_F(SmearedDepth, TheRimOfAnObjectIsSeen) {
  const Visibility visibility = ObservedDepth(observations_).visibility(*object_, scene_.T_camera_object, 1000);
  EXPECT_GT(visibility.seen, 100);
  EXPECT_LT(visibility.inconsistent(), 0.02);

  // Not where there is none.
  SE3 shifted = scene_.T_camera_object;
  shifted.t.x() += 0.02;
  EXPECT_GT(ObservedDepth(observations_).visibility(*object_, shifted, 1000).inconsistent(), 0.3);
}

TEST_F(SmearedDepth, AThinObjectHasAsManyPointsAsAreWanted) {
  std::vector<Eigen::Vector3f> points;
  ObservedDepth(observations_).points_near(*object_, scene_.T_camera_object, 0.002, 400, points);
  EXPECT_LE(points.size(), 400u);
  EXPECT_GT(points.size(), 150u);
}

TEST(Outline, OfAnObjectInAirIsNotContinuedButThatOfAPartOfAWallIs) {
  const KnownObjectPtr box = make_known_object(test::box_mesh({0.08f, 0.06f, 0.02f}), 1);
  test::ObjectScene scene;
  scene.object = box.get();
  scene.T_camera_object = {exp_so3({0, 0, 0.4}), {0.01, 0, 0.5}};
  const HandObservations in_air{scene.observe(0)};
  EXPECT_LT(ObservedDepth(in_air).continued(*box, scene.T_camera_object), 0.05);

  // Its front is where the wall is.
  scene.object = nullptr;
  const HandObservations wall{scene.observe(0)};
  const SE3 within{Eigen::Matrix3d::Identity(), {0.01, 0, test::ObjectScene::kWall + 0.01}};
  EXPECT_GT(ObservedDepth(wall).continued(*box, within), 0.95);

  // A hand hides half of the outline, which then says nothing.
  scene.covered_from = 100;
  const HandObservations covered{scene.observe(0)};
  EXPECT_GT(ObservedDepth(covered).continued(*box, within), 0.95);
}

}  // namespace
}  // namespace barehand
