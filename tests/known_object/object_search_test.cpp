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

std::optional<FoundPose> search(const KnownObject& wanted, const test::ObjectScene& scene) {
  const auto seen = scene.observe(0);
  const HandObservations observations{seen};
  std::vector<Vector3f> points;
  for (const SurfacePoint& point : test::ObjectScene::points(*seen)) points.push_back(point.p);
  if (points.empty()) return std::nullopt;
  return ObjectSearch().search(wanted, ObservedDepth(observations), points, points.front());
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
    const auto pose = search(*hammer, scene);
    found += pose && (pose->T_camera_object.t - scene.T_camera_object.t).norm() < 0.003 &&
             log_so3(pose->T_camera_object.R * scene.T_camera_object.R.transpose()).norm() < 3 * kDegree;
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
    const auto wrong = search(*hammer, scene);
    EXPECT_FALSE(wrong) << other->name << " explained " << wrong->quality.explained << " doubtful "
                        << wrong->quality.visibility.inconsistent() << " shown " << wrong->quality.visibility.shown();
    const auto right = search(*other, scene);
    ASSERT_TRUE(right) << other->name;
    EXPECT_LT(right->quality.cost(), 0.3);
  }
}

}  // namespace
}  // namespace barehand
