#include "stages/known_object/object_search.h"

#include <gtest/gtest.h>

#include "known_object/object_scene.h"
#include "math/angles.h"
#include "math/random.h"
#include "support/solid_meshes.h"

namespace barehand {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

std::vector<FoundPose> search(const KnownObjectPtr& wanted, const test::ObjectScene& scene, int parts = 1) {
  const auto seen = scene.observe(0);
  const HandObservations observations{seen};
  std::vector<Vector3f> points;
  for (const SurfacePoint& point : test::ObjectScene::points(*seen)) points.push_back(point.p);
  if (points.empty()) return {};
  ObjectSearch search(wanted);
  search.begin(ObservedDepth(observations), points, points.front());
  int part = 0;
  while (search.under_way() && !search.advance(1.0 / parts)) EXPECT_LT(++part, parts);
  EXPECT_FALSE(search.under_way());
  return {search.found().begin(), search.found().end()};
}

TEST(ObjectSearch, FindsAnObjectInAnyOrientation) {
  const KnownObjectPtr hammer = make_known_object(test::hammer_mesh(), 1);
  KeyedRandom random(4, 1);
  int found = 0;
  constexpr int kPoses = 12;
  for (int i = 0; i < kPoses; ++i) {
    const Vector3d turn(random.normal(), random.normal(), random.normal());
    test::ObjectScene scene;
    scene.object = hammer.get();
    scene.T_camera_object = {exp_so3(2 * turn), {random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), 0.5}};
    const auto poses = search(hammer, scene);
    if (poses.empty()) continue;
    const SE3& T = poses.front().T_camera_object;
    found += (T.t - scene.T_camera_object.t).norm() < 0.003 &&
             log_so3(T.R * scene.T_camera_object.R.transpose()).norm() < 3 * kDegree;
  }
  EXPECT_GE(found, kPoses - 2);
}

TEST(ObjectSearch, FindsNothingWhereSomethingElseIs) {
  const KnownObjectPtr hammer = make_known_object(test::hammer_mesh(), 1);
  const KnownObjectPtr ball = make_known_object(test::ball_mesh(0.04f), 2);
  const KnownObjectPtr box = make_known_object(test::box_mesh({0.08f, 0.15f, 0.05f}), 3);
  for (const KnownObjectPtr& other : {ball, box}) {
    test::ObjectScene scene;
    scene.object = other.get();
    scene.T_camera_object = {exp_so3({0.3, 0.2, 0.1}), {0, 0, 0.5}};
    const auto wrong = search(hammer, scene);
    EXPECT_TRUE(wrong.empty()) << other->name << " explained " << wrong[0].quality.explained << " doubtful "
                               << wrong[0].quality.visibility.inconsistent() << " shown "
                               << wrong[0].quality.visibility.shown();
    const auto right = search(other, scene);
    ASSERT_FALSE(right.empty()) << other->name;
    EXPECT_LT(right.front().quality.cost(), 0.3);
  }
}

TEST(ObjectSearch, FindsAllPosesThatAHandMakesAlike) {
  const KnownObjectPtr box = make_known_object(test::box_with_knob(), 1);
  test::ObjectScene scene;
  scene.object = box.get();
  scene.T_camera_object = test::knob_right(0.2, true);
  scene.covered_from = test::kKnob;
  const auto poses = search(box, scene);
  ASSERT_GE(poses.size(), 2u);
  EXPECT_LE(poses.size(), ObjectSearch::kMostPoses);
  EXPECT_TRUE(std::ranges::any_of(poses, [&](const FoundPose& pose) {
    return log_so3(pose.T_camera_object.R * scene.T_camera_object.R.transpose()).norm() < 5 * kDegree;
  }));
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_GE(poses[i].quality.cost(), poses[i - 1].quality.cost());
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GT(log_so3(poses[i].T_camera_object.R * poses[k].T_camera_object.R.transpose()).norm(), 20 * kDegree);
  }
}

TEST(ObjectSearch, InPartsItFindsTheSame) {
  const KnownObjectPtr hammer = make_known_object(test::hammer_mesh(), 1);
  test::ObjectScene scene;
  scene.object = hammer.get();
  scene.T_camera_object = {exp_so3({0.4, 2.0, 0.3}), {0, 0.01, 0.5}};
  const auto whole = search(hammer, scene), in_parts = search(hammer, scene, 7);
  ASSERT_FALSE(whole.empty());
  ASSERT_EQ(in_parts.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i)
    EXPECT_EQ(in_parts[i].T_camera_object.R, whole[i].T_camera_object.R) << i;
}

TEST(ObjectSearch, AmongTooFewPointsNothingIsUnderWay) {
  const KnownObjectPtr ball = make_known_object(test::ball_mesh(0.04f), 1);
  test::ObjectScene scene;
  const HandObservations observations{scene.observe(0)};
  ObjectSearch search(ball);
  search.begin(ObservedDepth(observations), std::vector<Vector3f>(10, {0, 0, 0.5f}), {0, 0, 0.5f});
  EXPECT_FALSE(search.under_way());
  EXPECT_FALSE(search.advance(1));
  EXPECT_TRUE(search.found().empty());
}

TEST(ObjectSearch, TurnsOfASymmetricObjectAreOnePose) {
  const KnownObjectPtr ball = make_known_object(test::ball_mesh(0.04f), 1);
  test::ObjectScene scene;
  scene.object = ball.get();
  scene.T_camera_object = {Eigen::Matrix3d::Identity(), {0, 0, 0.5}};
  EXPECT_EQ(search(ball, scene).size(), 1u);
}

}  // namespace
}  // namespace barehand
