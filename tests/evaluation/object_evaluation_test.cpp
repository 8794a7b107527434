#include "evaluation/object_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numbers>

#include "math/angles.h"
#include "support/solid_meshes.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using testing::HasSubstr;

const SE3 kPose{exp_so3({0.1, 0.2, 0.3}), {0, 0, 0.5}};

ObjectTruthTable truth(int frames) {
  ObjectTruthTable table{"thing", {}};
  for (int i = 0; i < frames; ++i) table.poses[i] = kPose;
  return table;
}

TEST(ObjectEvaluation, MeasuresPositionRotationAndSurface) {
  const SE3 moved{exp_so3({0, 0, 5 * kDegree}) * kPose.R, kPose.t + Eigen::Vector3d(0.003, 0.004, 0)};
  const auto box = evaluate_object(truth(1), {{0, moved}}, test::box_mesh({0.1f, 0.02f, 0.02f}));
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->position.mean, 0.005, 1e-9);
  EXPECT_NEAR(box->rotation.mean, 5 * kDegree, 1e-9);
  EXPECT_EQ(box->turned, 0u);
  EXPECT_GT(box->surface.mean, 0.001);
}

TEST(ObjectEvaluation, ATurnedBallHasTheSameSurface) {
  const SE3 turned{exp_so3({1, 2, 0}) * kPose.R, kPose.t};
  const auto ball = evaluate_object(truth(1), {{0, turned}}, test::ball_mesh(0.04f));
  ASSERT_TRUE(ball);
  EXPECT_GT(ball->rotation.mean, 0.5);
  EXPECT_LT(ball->surface.mean, 0.0005);
}

/// A box off its origin with a square knob in the middle of its upper side [m].
ObjectMesh box_with_knob_above(float width, float height) {
  ObjectMesh mesh = test::box_mesh({0.1f, 0.06f, 0.03f});
  test::add(mesh, test::box_mesh({width, width, height}), {0, 0, 0.015f + 0.5f * height});
  for (auto& v : mesh.vertices) v.x() += 0.04f;
  return mesh;
}

/// The evaluation of a pose that is half a turn about `axis` of the mesh and 3 degrees wrong.
ObjectEvaluation turned(const ObjectMesh& mesh, const Eigen::Vector3d& axis) {
  const Eigen::Matrix3d R = exp_so3(std::numbers::pi * axis);
  const Eigen::Vector3d middle(0.04, 0, 0);
  const SE3 half_turn{R, middle - R * middle}, off{exp_so3({0, 3 * kDegree, 0}), {0.002, 0, 0}};
  return evaluate_object(truth(1), {{0, kPose * half_turn * off}}, mesh).value();
}

TEST(ObjectEvaluation, AHalfTurnThatNobodySeesIsNoError) {
  // A low knob moves the surface by less than 0.5 mm in the mean.
  const ObjectMesh low = box_with_knob_above(0.008f, 0.002f);
  for (const Eigen::Vector3d axis : {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ()}) {
    const ObjectEvaluation e = turned(low, axis);
    EXPECT_EQ(e.symmetries.size(), 3u);
    EXPECT_LT(*std::ranges::max_element(e.symmetries), kSameSurfaceTurned);
    EXPECT_EQ(e.turned, 1u);
    EXPECT_NEAR(e.rotation.mean, 3 * kDegree, 0.1 * kDegree) << axis.transpose();
    EXPECT_LT(e.position.mean, 0.006) << axis.transpose();
  }

  // A high one is seen, unless the turn is about its own axis.
  const ObjectMesh high = box_with_knob_above(0.02f, 0.03f);
  const ObjectEvaluation wrong = turned(high, Eigen::Vector3d::UnitX());
  EXPECT_EQ(wrong.symmetries.size(), 1u);
  EXPECT_GT(wrong.rotation.mean, 170 * kDegree);
  EXPECT_NEAR(turned(high, Eigen::Vector3d::UnitZ()).rotation.mean, 3 * kDegree, 0.1 * kDegree);
}

TEST(ObjectEvaluation, FramesWithoutAPoseAreLostOnlyAfterTheFirstOne) {
  const auto e = evaluate_object(truth(6), {{2, kPose}, {4, kPose}}, test::box_mesh({0.1f, 0.1f, 0.1f}));
  ASSERT_TRUE(e);
  EXPECT_EQ(e->frames, 6u);
  EXPECT_EQ(e->stated, 2u);
  EXPECT_EQ(e->lost, 2u);
  EXPECT_FALSE(evaluate_object(truth(3), {{7, kPose}}, test::box_mesh({0.1f, 0.1f, 0.1f})));
}

TEST(ObjectEvaluation, ErrorsNameTheLineOfTheTable) {
  const test::TempFolder folder;
  const auto refusal = [&](const std::string& text) {
    const std::string path = folder.path() + "/objects.csv";
    std::ofstream(path) << text;
    const auto table = read_object_truth(path);
    return table ? "read" : table.error().message();
  };
  const std::string header = "utime,object,held,x,y,z,qw,qx,qy,qz\n";
  EXPECT_EQ(refusal(header + "1,mug,0,0,0,1,1,0,0,0\n"), "read");
  EXPECT_THAT(refusal(header), HasSubstr("holds no poses"));
  EXPECT_THAT(refusal("a,b\n"), HasSubstr("line 1"));
  EXPECT_THAT(refusal(header + "1,mug,0,0,0,nan,1,0,0,0\n"), HasSubstr("line 2"));
  EXPECT_THAT(refusal(header + "1,mug,0,0,0,1,2,0,0,0\n"), HasSubstr("unit quaternion"));
  EXPECT_THAT(refusal(header + "1,mug,0,0,0,1,1,0,0,0\n2,cup,0,0,0,1,1,0,0,0\n"), HasSubstr("another object"));
}

}  // namespace
}  // namespace barehand
