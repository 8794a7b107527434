#include "drivers/synthetic/people/people_sequences.h"

#include <gmock/gmock.h>

#include "drivers/synthetic/hand/animated_hand.h"
#include "drivers/synthetic/people/arm.h"
#include "drivers/synthetic/people/body.h"
#include "drivers/synthetic/rendering/body_shapes.h"
#include "tests/synthetic/small_simulator.h"

namespace barehand::synthetic {
namespace {

SimulatorParams scene(const std::string& name, int seed) {
  SimulatorParams params = small_scene(name);
  params.seed = seed;
  return params;
}

/// Fraction of the pixels nearer than 1.5 m.
double near_fraction(const RgbdFrame& frame) {
  int count = 0;
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const double z = frame.depth_unit * frame.depth[i];
    count += z > 0 && z < 1.5;
  }
  return static_cast<double>(count) / static_cast<double>(frame.depth.size());
}

TEST(Arm, HasTheLengthsThatItsSizeStates) {
  const ArmSize arm;
  const Eigen::Vector3d shoulder(0.1, 0.2, 0.3), down(0, 0, -1);
  for (const double distance : {0.1, 0.3, 0.5}) {
    const Eigen::Vector3d wrist = shoulder + distance * Eigen::Vector3d(1, 2, 1).normalized();
    const Eigen::Vector3d elbow = elbow_between(arm, shoulder, wrist, down);
    EXPECT_NEAR((elbow - shoulder).norm(), arm.upper, 1e-9);
    EXPECT_NEAR((wrist - elbow).norm(), arm.forearm, 1e-9);
    EXPECT_LT(elbow.z(), 0.5 * (shoulder + wrist).z()) << "the elbow is below";
  }
}

TEST(Arm, IsStraightTowardsWhatItDoesNotReach) {
  const ArmSize arm;
  const Eigen::Vector3d elbow = elbow_between(arm, {0, 0, 0}, {2, 0, 0}, {0, 0, -1});
  EXPECT_NEAR(elbow.x(), arm.upper, 0.01);
  EXPECT_NEAR(elbow.norm(), arm.upper, 1e-9);
}

TEST(BodyShapes, NormalsPointOutwards) {
  for (const TriangleMesh& mesh : {make_ellipsoid({0.1, 0.2, 0.3}), make_limb(0.3, 0.05, 0.04)}) {
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (const auto& v : mesh.vertices) middle += v / static_cast<float>(mesh.vertices.size());
    int inwards = 0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      inwards += mesh.normals[i].dot(mesh.vertices[i] - middle) <= 0;
    EXPECT_EQ(inwards, 0);
  }
}

class HandOfAPerson : public testing::TestWithParam<std::string> {};

TEST_P(HandOfAPerson, IsInViewAndWithinReachOfTheBody) {
  for (int seed = 1; seed <= 12; ++seed) {
    Simulator sim = simulator(scene(GetParam(), seed));
    const Intrinsics& camera = sim.camera();
    for (std::int64_t i = 0; i < sim.frame_count(); i += 30) {
      const SimulatedFrame frame = sim.render(i);
      ASSERT_TRUE(frame.hands.front().table.has_value()) << "seed " << seed << ", frame " << i;
      double seen = 0;
      for (const TableRow& row : frame.hands.front().table->rows) {
        const Eigen::Vector2d pixel = camera.project(row.distal);
        EXPECT_TRUE(pixel.x() > 0 && pixel.x() < camera.width && pixel.y() > 0 && pixel.y() < camera.height)
            << "seed " << seed << ", frame " << i;
        seen += row.visible / kSegmentCount;
      }
      EXPECT_GT(seen, 0.12) << "seed " << seed << ", frame " << i;
      EXPECT_GT(near_fraction(*frame.frame), 0.1) << "body or desk surround the hand";
    }
  }
}

TEST_P(HandOfAPerson, IsTheLeftOneInAMirror) {
  SimulatorParams params = scene(GetParam(), 3);
  Simulator right = simulator(params);
  params.hand = "left";
  Simulator left = simulator(params);
  const SimulatedFrame a = right.render(10), b = left.render(10);
  EXPECT_NEAR(a.hands.front().pose[kPalm].t.x(), -b.hands.front().pose[kPalm].t.x(), 1e-9);
  EXPECT_EQ(left.hands().front().side(), Handedness::left);
}

TEST_P(HandOfAPerson, AndItsSceneDependOnTheSeed) {
  Simulator one = simulator(scene(GetParam(), 1)), other = simulator(scene(GetParam(), 2));
  const SimulatedFrame a = one.render(0), b = other.render(0);
  EXPECT_GT((a.hands.front().pose[kPalm].t - b.hands.front().pose[kPalm].t).norm(), 0.002);
  EXPECT_GT(std::abs(near_fraction(*a.frame) - near_fraction(*b.frame)), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(People, HandOfAPerson, testing::Values("person", "desk", "egocentric"),
                         [](const auto& info) { return info.param; });

class WithoutAHand : public testing::TestWithParam<std::string> {};

TEST_P(WithoutAHand, ShowsSomethingThatMovesAndNoHand) {
  for (int seed = 1; seed <= 6; ++seed) {
    Simulator sim = simulator(scene(GetParam(), seed));
    EXPECT_TRUE(sim.hands().empty());
    const SimulatedFrame first = sim.render(0), later = sim.render(20);
    EXPECT_TRUE(first.hands.empty());
    EXPECT_GT(near_fraction(*first.frame), 0.1) << "seed " << seed;
    int differing = 0;
    for (std::size_t i = 0; i < first.frame->depth.size(); ++i)
      differing += first.frame->depth[i] != later.frame->depth[i];
    EXPECT_GT(differing, 1000) << "seed " << seed;
  }
}

TEST_P(WithoutAHand, HasNoLeftHand) {
  SimulatorParams params = scene(GetParam(), 1);
  params.hand = "left";
  const auto made = Simulator::create(params);
  ASSERT_FALSE(made.has_value());
  EXPECT_THAT(made.error().message(), testing::HasSubstr("shows no hand"));
}

INSTANTIATE_TEST_SUITE_P(People, WithoutAHand, testing::Values("empty_person", "empty_desk", "faces", "feet"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace barehand::synthetic
