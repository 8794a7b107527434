#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/synthetic/rendering/shapes.h"
#include "drivers/synthetic/sequences/grasp_planner.h"
#include "tests/synthetic/test_hand.h"

namespace barehand::synthetic {
namespace {

TEST(SignedDistances, AreThoseOfTheSurfaces) {
  EXPECT_NEAR(sphere_distance(0.03)({0.05, 0, 0}), 0.02, 1e-12);
  const auto cylinder = cylinder_distance(0.04, 0.05);
  EXPECT_NEAR(cylinder({0.06, 0, 0}), 0.02, 1e-12);
  EXPECT_NEAR(cylinder({0, 0, 0.045}), -0.005, 1e-12);
  EXPECT_NEAR(cylinder({0.07, 0, 0.09}), 0.05, 1e-12);
  EXPECT_NEAR(tube_distance({{0, 0, 0}, {0.1, 0, 0}}, 0.01)({0.05, 0.03, 0}), 0.02, 1e-12);
}

class Grasp : public HandTest {};

TEST_F(Grasp, ClosesUntilTheSkinTouchesAndNotThrough) {
  const HandRig hand = rig();
  const GraspPlanner planner(hand);
  const auto ball = sphere_distance(0.033);
  HandAngles closed = fist();

  // The open hand touches the ball with the palm only.
  const SE3 T = planner.place_at_palm({Eigen::Matrix3d::Identity(), {-0.01, -0.1, -0.09}}, -Eigen::Vector3d::UnitY(),
                                      ball, open_spread());
  const auto open_gap = planner.clearance(open_spread(), T, ball);
  EXPECT_NEAR(*std::min_element(open_gap.begin(), open_gap.end()), 0.0005, 1e-4);

  // The closed hand touches it with its fingers and does not pass through.
  const auto gap = planner.clearance(planner.close(open_spread(), closed, T, ball), T, ball);
  for (int finger = 1; finger <= 3; ++finger) {
    double nearest = 1;
    for (int k = 0; k < 3; ++k) nearest = std::min(nearest, gap[segment_of(finger, k)]);
    EXPECT_LT(nearest, 0.001) << "finger " << finger << " does not touch";
  }
  for (int s = 0; s < kSegmentCount; ++s) EXPECT_GT(gap[s], -0.002) << kSegmentNames[s];
}

/// Smallest distance between the skin and the object [m]: over the whole sequence, and while the object is held.
struct Contact {
  double ever = 1, held = 1;
};
Contact contact(const HandRig& hand, const std::string& name, const SignedDistance& object_distance) {
  const auto sequence = make_sequence(name, &hand, 1);
  const Skinner skinner(hand.mesh);
  std::vector<Eigen::Vector3f> skin;
  Contact result;

  // The distance over time.
  for (double time = 0; time < (*sequence)->duration(); time += 0.1) {
    const SceneState state = (*sequence)->at(time);
    skinner.deform(pose_segments(hand.profile, state.hands.front().skeleton), skin);
    const SE3 T_object_camera = state.T_camera_object[0].inverse();
    double nearest = 1;
    for (const auto& v : skin) nearest = std::min(nearest, object_distance(T_object_camera * v.cast<double>()));
    result.ever = std::min(result.ever, nearest);
    if (std::abs(time - 4.0) < 0.05) result.held = nearest;
  }
  return result;
}

TEST_F(Grasp, SequencesHoldTheirThingsAtTheSkinAndNeverReachThrough) {
  for (const auto& [name, object_distance] :
       {std::pair{"grasp_ball", sphere_distance(0.0325)}, std::pair{"grasp_mug", cylinder_distance(0.04, 0.055)}}) {
    const Contact c = contact(rig(), name, object_distance);
    EXPECT_LT(c.held, 0.001) << name;
    EXPECT_GT(c.ever, -0.003) << name;
  }
}

}  // namespace
}  // namespace barehand::synthetic
